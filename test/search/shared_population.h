#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "search/mutation.h"
#include "search/search_scenes.h"
#include "search/trial_point_table.h"

namespace concave_distance::test {

/// Individuals on few places, as after descents.
struct SharedPopulation {
  PairScene scene = shellsAndShells();
  PairObjective objective{*scene.a, *scene.b, scene.a_from_b};
  PairMetric metric{*scene.a, *scene.b};
  TrialPointTable places;
  std::vector<std::uint32_t> where;
  Census census;

  void fill(std::uint32_t individuals, std::uint32_t distinct, RandomEngine& engine) {
    places.reset(std::numeric_limits<double>::infinity());
    where.clear();
    SearchCost cost;
    std::vector<TrialPoint> points;
    for (std::uint32_t i = 0; i < distinct; ++i) {
      const TrialPoint point = randomTrialPoint(objective, engine);
      points.push_back(objective.evaluate(point.node_a, point.node_b, cost));
    }
    for (std::uint32_t i = 0; i < individuals; ++i) {
      where.push_back(places.placeOf(points[uniformIndex(engine, distinct)]));
    }
    census.take(where, places.size());
  }

  double delta(std::uint32_t i, std::uint32_t j) {
    return metric.distanceWithin(places.point(where[i]), places.point(where[j]),
                                 std::numeric_limits<double>::infinity());
  }
};

}  // namespace concave_distance::test
