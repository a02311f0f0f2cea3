#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/side.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/distance/niche_kind.h"
#include "distance/kernels/witness_refinement.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {

/// Limits how much a plateau's distance may vary, relative to the bodies: far above the kernels' rounding.
inline constexpr double kPlateauTolerance = 1e-9;

/// Describes the set of all minimisers connected with a witness pair. The vector from A's point to B's is the
/// same for all of them, so that the set is the overlap, seen along it, of what both bodies have level there.
struct NicheExtent {
  NicheKind kind = NicheKind::Point;  ///< Segment: extended in one direction, Patch: in two
  double length = 0.0;  ///< metres, largest distance between two points of the set on A; 0 for a point
  /// A stable representative of the set: the point nearest to the centre of its smallest enclosing circle,
  /// with the distance of the witness given up to 4 times the kernel's error; the witness itself for a point
  /// and where the set is level within the tolerance only.
  WitnessPair representative;
  bool cut = false;  ///< the set spans more triangle pairs than were looked at
  /// The set is a terrace and no local minimum: the triangle pair (down_a, down_b) at its border comes
  /// closer.
  bool leads_down = false;
  TriangleIndex down_a;
  TriangleIndex down_b;
};

/// Buffers of one thread; cleared, never freed.
struct ExtentWorkspace {
  struct Piece {
    std::uint32_t pair;   ///< of `open`
    std::uint32_t first;  ///< of `points`
    std::uint32_t count;
  };
  RefinementWorkspace ring;
  std::vector<std::pair<TriangleIndex, TriangleIndex>> open;  ///< in order of discovery
  std::vector<std::pair<TriangleIndex, TriangleIndex>> seen;  ///< the same, sorted
  std::vector<Piece> pieces;
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector2d> corners;
  std::vector<Eigen::Vector2d> polygon;
  std::vector<Eigen::Vector2d> hull;
  /// These describe the set measured last, A's frame: a point of its plane on A, the unit vector towards B,
  /// the axes of the two-dimensional coordinates; how far points may be off, metres.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_x = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_y = Eigen::Vector3d::Zero();
  double reach = 0.0;
};

inline constexpr std::size_t kLargestRings = std::size_t{1} << 20U;

/// Collects the triangle pairs around a refined witness that reach the same distance (up to `tolerance`,
/// metres, and the kernel's error) and measures the set, whichever of its triangle pairs the witness is from.
/// Sideways the tolerance goes as far as it lengthens the distance d by no more: sqrt(2 d tolerance).
/// Looks at no more than `pair_limit` triangle pairs and says when it cut. A witness that is the only closest
/// point of its own surroundings, on either body, costs no more than looking around it. Touching witnesses
/// (distance 0) are points, and so is every set when twice the sideways tolerance is as long as a body,
/// because so far apart a set cannot be distinguished from a point. Cost: at most pair_limit and 2^20 steps
/// at any distance.
/// @param limit may cut the set shorter; nullptr: none
/// @param ring_limit triangles around corners of the set to look at: many where those are shorter than the
/// sideways tolerance; some 60 ns each
NicheExtent measureExtent(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                          const WitnessPair& witness, double tolerance, std::size_t pair_limit,
                          ExtentWorkspace& workspace, WorkLimit* limit = nullptr,
                          std::size_t ring_limit = kLargestRings);

/// Gives the point pair just inside a corner of a piece of the set measured last: each point the closest to
/// the other on its triangle; nothing for a piece that is a point.
std::optional<WitnessPair> cornerOf(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                    const ExtentWorkspace& measured, const ExtentWorkspace::Piece& piece,
                                    std::uint32_t corner);

/// Sign of the witness direction against the pseudonormals at both witnesses (Baerentzen and Aanaes 2005),
/// which separates outside from inside where the witness is a local minimum. For touching witnesses (distance
/// 0) Outward.
Outwardness classifyOutwardness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                const WitnessPair& witness);

/// True when no triangle of either body meets the open segment between the witness points, but for 1e-12 of
/// the bodies' size at its ends. O(log n) where nothing is near.
bool isVisible(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness);

/// A triangle that was between witness points at an earlier pose.
struct Occluder {
  Side side = Side::A;
  TriangleIndex triangle = kNoTriangle;
};
/// The same; the occluder is looked at first, and is what was found.
bool isVisible(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness, Occluder& occluder);

}  // namespace concave_distance
