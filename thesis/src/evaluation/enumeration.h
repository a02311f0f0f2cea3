#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/witness_refinement.h"

namespace concave_distance {

/// The node pair of least distance over all pairs (Carretero, app. D): the oracle of every combinatorial
/// figure. Ties go to the smaller (node_a, node_b). O(nodes_a * nodes_b), parallel over A's nodes.
struct NodePairMinimum {
  double squared_distance;
  NodeIndex node_a;
  NodeIndex node_b;
};
NodePairMinimum enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

/// The closest witness pair over all pairs of original triangles, by brute force, parallel over A's
/// triangles.
WitnessPair enumerateTrianglePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

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
/// grid, an oracle for tests and benchmarks. Plateaus count once. Passes above the cutoff count as infinite
/// unless a deeper niche is reached below it. Memory: 16 bytes per node pair below the cutoff.
/// Ascending by distance. @throws Error when more than `pair_limit` node pairs lie below the cutoff
std::vector<NodeNiche> enumerateNodeNiches(const BodyMesh& a, const BodyMesh& b,
                                           const Eigen::Isometry3d& a_from_b, double cutoff,
                                           double least_prominence, std::size_t pair_limit = 100'000'000);

}  // namespace concave_distance
