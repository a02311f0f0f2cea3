#pragma once

#include <Eigen/Core>

#include "concave_distance/search/trial_point.h"
#include "search/grid/node_graph.h"

namespace concave_distance {

/// Says where a walk over a body's nodes has ended.
struct Approach {
  NodeIndex node;
  bool proven;  ///< none of its neighbours is closer, whatever the rounding
};

/// Walks in float to where no neighbour looks closer to `target` (metres, in the graph's frame).
Approach approach(const NodeGraph& graph, NodeIndex node, const Eigen::Vector3d& target, SearchCost& cost);

}  // namespace concave_distance
