#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "bound_cache.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/distance/certificate_cost.h"
#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/witness_refinement.h"

namespace concave_distance {

/// Says how far a proof of the distance is to go; the default is to the end.
struct CertificateRequest {
  double absolute_tolerance = 0.0;  ///< metres: the bound may stay this far below the distance
  double relative_tolerance = 0.0;  ///< of the distance less the margin; the larger of the two counts
  double margin = 0.0;              ///< metres, of both bodies together
  /// The proof stops with the bound that it has when this is reached; nullptr is no limit.
  WorkLimit* limit = nullptr;
  /// Metres: a larger bound is not asked for, and starts need not be refined.
  double far_enough = std::numeric_limits<double>::infinity();

  /// How far below a distance its bound may stay, metres.
  double toleranceAt(double distance) const {
    return std::max(
        {absolute_tolerance, relative_tolerance * std::max(0.0, distance - margin), distance - far_enough});
  }
};

enum class CertificateStatus : std::uint8_t {
  Proven,      ///< lower_bound = distance - E, rounded down, not below 0
  Tolerance,   ///< lower_bound is within the tolerance asked for
  Budget,      ///< time or memory ran out first; lower_bound still holds
  Penetrating  ///< the surfaces meet, up to the kernel's error: distance 0, witness names the triangles
};
std::string_view toString(CertificateStatus status);

/// Says that lower_bound <= distance of the surfaces <= distance, for the pose as given.
struct DistanceCertificate {
  WitnessPair witness;
  double distance = std::numeric_limits<double>::infinity();
  double lower_bound = 0.0;
  CertificateStatus status = CertificateStatus::Budget;
  /// True when a pair closer than every start by more than the error was found.
  bool improved = false;
  CertificateCost cost;
};

/// E: the error of a proof, relative to the scene's scale (proofScale). Composed of the kernel's 32 machine
/// epsilons, the widening of the boxes (32) and the rounding of their bounds (2 x 16): doc/numerics.md.
inline constexpr double kProofError = 0x1.0p-45;  // 128 machine epsilons
/// A pose and its product with a far centre lose at most 16 machine epsilons of their size to rounding: this
/// share of kProofError.
inline constexpr double kPoseShare = 0.125;

/// Returns the scene's scale that errors are relative to: how far the bodies' surfaces reach from their
/// centres, how far these are apart, and for the rounding of the pose an eighth of how far they and B's frame
/// are from the origins of their frames. Metres.
double proofScale(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

/// Keeps how far one tree's boxes reach along one direction; valid where the stamp is the current one.
struct SupportCache {
  std::vector<double> values;
  std::vector<std::uint32_t> stamps;
  std::uint32_t stamp = 0;
};

/// Holds the buffers of one thread, which are cleared and never freed: 48 bytes for each node of both
/// hierarchies.
struct CertificateWorkspace {
  /// A pair of boxes that may hide a closer pair of triangles.
  struct OpenPair {
    BoundingVolumeHierarchy::Slot a;
    BoundingVolumeHierarchy::Slot b;
    double squared_bound;
  };
  std::vector<OpenPair> open;
  SupportCache support_a;
  SupportCache support_b;
  RefinementWorkspace refinement;
};

/// Returns the distance of the two surfaces with a proof, by branch and bound over both bodies' hierarchies
/// (Larsen et al. 1999, with the direction between the best witnesses as a further separating axis). `starts`
/// are pairs of triangles to begin with, the likeliest first; each is refined to its local minimum, unless a
/// bound is far enough. Without starts the search dives for one. Anytime: see CertificateRequest; the bound
/// only rises and the distance only falls. Solids that hold one another are not looked for: this is the
/// distance of the surfaces. a_from_b must be rigid to rounding. Allocates nothing once the workspace has
/// grown.
DistanceCertificate certifyDistance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                    const TrianglePair* starts, std::size_t start_count,
                                    const CertificateRequest& request, CertificateWorkspace& workspace,
                                    BoundCache* cache = nullptr);

}  // namespace concave_distance
