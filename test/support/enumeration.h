#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "concave_distance/distance/witness.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"

/// The oracles of the search and of the proof: every pair is looked at.
namespace concave_distance::test {

/// The closest witness pair over all pairs of original triangles, by brute force.
WitnessPair enumerateTrianglePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

/// The node pair of least distance over all pairs. Ties go to the smaller (node_a, node_b).
TrialPoint enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

/// A local minimum of the node-to-node distance over the product of both graphs, where one gene moves at a
/// time.
struct NodeNiche {
  double distance;
  NodeIndex node_a;
  NodeIndex node_b;
  double prominence;  ///< pass level / distance - 1, the pass to a niche at least as deep; infinite for the
                      ///< deepest
};

/// Every local minimum below `cutoff` (metres) whose prominence is at least `least_prominence`, by flooding
/// the product graph in order of distance (0-dimensional persistence): the ground truth for the search on a
/// grid. Plateaus count once. Passes above the cutoff count as infinite unless a deeper niche is reached
/// below it. Memory: 16 bytes per node pair below the cutoff. Ascending by distance.
/// @throws Error when more than `pair_limit` node pairs lie below the cutoff
std::vector<NodeNiche> enumerateNodeNiches(const BodyMesh& a, const BodyMesh& b,
                                           const Eigen::Isometry3d& a_from_b, double cutoff,
                                           double least_prominence, std::size_t pair_limit = 100'000'000);

}  // namespace concave_distance::test
