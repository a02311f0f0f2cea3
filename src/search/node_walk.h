#pragma once

#include <Eigen/Core>

#include "concave_distance/search/trial_point.h"
#include "search/grid/body_grid.h"

namespace concave_distance {

/// Says where a walk over a body's nodes has ended.
struct Approach {
  NodeIndex node;
  bool proven;  ///< none of its neighbours is closer, whatever the rounding
};

/// Walks in float to where no neighbour looks closer to `target` (metres, in the graph's frame).
/// @param in_long_steps on graphs with levels (SearchNodes::levels) steps grow with the length of the walk
Approach approach(const BodyGrid& grid, NodeIndex node, const Eigen::Vector3d& target, bool in_long_steps,
                  SearchCost& cost);

}  // namespace concave_distance
