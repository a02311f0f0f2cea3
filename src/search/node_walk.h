#pragma once

#include <Eigen/Core>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// Says where a walk over a body's nodes has ended.
struct Approach {
  NodeIndex node;
  bool proven;  ///< none of its neighbours is closer, whatever the rounding
};

/// Walks in float to where no neighbour looks closer to `target` (metres, in the graph's frame).
/// @param in_long_steps on graphs with levels (BodyMesh::levels()) steps are the longer the longer the walk
/// is
Approach approach(const BodyMesh& body, NodeIndex node, const Eigen::Vector3d& target, bool in_long_steps,
                  SearchCost& cost);

}  // namespace concave_distance
