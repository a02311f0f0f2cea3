#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "search/crowding.h"
#include "search/grid/body_grid.h"
#include "search/grid/geodesic_extent.h"
#include "search/search_scenes.h"
#include "support/shortest_path.h"

namespace concave_distance::test {

/// Places along the edge of one tooth: node k of A's path, always the same node of B, with distances given.
class PlacesOnAPath : public ::testing::Test {
 protected:
  PlacesOnAPath() : metric_(*scene_.a, *scene_.b) {
    places_.reset(std::numeric_limits<double>::infinity());
    const std::vector<double> length = pathLengthsFrom(gridOf(*scene_.a).graph(), {NodeIndex{0}});
    const auto farthest = std::max_element(length.begin(), length.end());
    path_ = shortestPath(gridOf(*scene_.a).graph(), NodeIndex{0},
                         NodeIndex{static_cast<std::size_t>(farthest - length.begin())});
  }

  Contestant at(std::size_t step, double squared_distance) {
    const TrialPoint point{path_.at(step), NodeIndex{3}, squared_distance};
    return {point, places_.placeOf(point)};
  }

  PairScene scene_ = facingCombs();
  PairMetric metric_;
  TrialPointTable places_;
  std::vector<NodeIndex> path_;
};

}  // namespace concave_distance::test
