#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// The node pair of least distance over all pairs (Carretero, app. D): the thesis's measure of every search.
/// Ties go to the smaller (node_a, node_b). O(nodes_a * nodes_b), parallel over A's nodes.
TrialPoint enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance
