#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "niche_properties.h"

namespace concave_distance {

/// A pair of points of two surfaces, as close as their features there let them be.
struct CornerPair {
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< metres
};

inline constexpr std::size_t kMostCorners = 8;
/// One more than the corners: the closest points of a round solid, which lie between two of them.
using CornerPairs = std::array<CornerPair, kMostCorners + 1>;

/// Buffers of one thread; cleared, never freed.
struct CornerWorkspace {
  ExtentWorkspace extent;
  std::vector<Eigen::Vector2d> hull;
  std::vector<NodeIndex> level;
  std::vector<bool> is_level;  ///< by node; false between calls
};

/// Finds the corners of what is level with a niche within `tolerance` (metres, of height above its points):
/// edges and faces that are parallel, or nearly. Between planes the distance is linear, so that no place
/// between the corners is nearer than the nearest of them. At most kMostCorners: those whose hull is largest.
/// A corner is a vertex and the point closest to it, or two edges that cross, at its own distance; sliding it
/// along its features changes nothing to first order.
/// @param least_length metres; a shorter set is a point
/// @param pair_limit @param ring_limit what to look at, as measureExtent()
/// @return how many were found; 0 for a set that is a point, touches or has more triangle pairs than that
std::size_t findCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                        const WitnessPair& witness, double tolerance, double least_length,
                        std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                        CornerPairs& corners);

}  // namespace concave_distance
