#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/distance/witness_refinement.h"

namespace concave_distance {

/// Whether a local minimum is one pair of points or a set of them (DESIGN.md, "What a niche is").
enum class NicheKind : std::uint8_t { Point, Segment, Patch };

/// Where the segment between the witness points runs.
enum class Outwardness : std::uint8_t {
  Outward,          ///< leaves both bodies outwards: a possible contact
  ThroughMaterial,  ///< leaves at least one closed shell inwards: its dark side, no possible contact
  Unknown           ///< at least one witness lies on an open shell that it leaves against its winding
};

/// The set of all minimisers connected with a witness pair.
struct NicheExtent {
  NicheKind kind = NicheKind::Point;
  double length = 0.0;  ///< metres, largest distance between two points of the set on A; 0 for a point
  /// A stable representative of the set (its middle), with the same distance as the witness given.
  WitnessPair representative;
  bool cut = false;  ///< the set spans more triangle pairs than were looked at
};

struct ExtentWorkspace {
  std::vector<std::pair<TriangleIndex, TriangleIndex>> open;
  std::vector<std::pair<TriangleIndex, TriangleIndex>> seen;
  std::vector<Eigen::Vector3d> polygon;
  std::vector<Eigen::Vector3d> clipped;
  std::vector<Eigen::Vector3d> points;
};

/// Collects the triangle pairs around a refined witness that reach the same distance (up to `tolerance`,
/// metres) and measures the set. Looks at no more than `pair_limit` triangle pairs and says when it cut.
NicheExtent measureExtent(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                          const WitnessPair& witness, double tolerance, std::size_t pair_limit,
                          ExtentWorkspace& workspace);

/// Sign of the witness direction against the pseudonormals at both witnesses (Baerentzen and Aanaes 2005).
/// For touching witnesses (distance 0) Outward.
Outwardness classifyOutwardness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                const WitnessPair& witness);

/// True when no triangle of either body meets the open segment between the witness points.
bool isVisible(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
               const WitnessPair& witness);

}  // namespace concave_distance
