#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "search/automatic_radii.h"
#include "search/grid/body_grid.h"
#include "search/grid/geodesic_extent.h"
#include "search/local_descent.h"
#include "search/mutation.h"
#include "search/replacement.h"
#include "search/search_scenes.h"
#include "search/search_workspace.h"
#include "search/trial_point_table.h"
#include "support/shortest_path.h"

/// These fixtures serve the tests of the search, here and in the thesis.
namespace concave_distance::test {

/// A pair of bodies with the distances of node pairs and between them.
struct MeasuredPair {
  PairScene scene;
  PairObjective objective;
  PairMetric metric;
  explicit MeasuredPair(PairScene made)
      : scene(std::move(made)), objective(*scene.a, *scene.b, scene.a_from_b), metric(*scene.a, *scene.b) {}

  /// A random node pair, with its distance.
  TrialPoint drawPoint(RandomEngine& engine) const {
    SearchCost cost;
    const TrialPoint point = randomTrialPoint(objective, engine);
    return objective.evaluate(point.node_a, point.node_b, cost);
  }
};

/// Individuals on few places, as after descents.
struct SharedPopulation : MeasuredPair {
  TrialPointTable places;
  std::vector<std::uint32_t> where;
  Census census;
  SharedPopulation() : MeasuredPair(shellsAndShells()) {}

  void fill(std::uint32_t individuals, std::uint32_t distinct, RandomEngine& engine) {
    places.clear();
    where.clear();
    std::vector<TrialPoint> points;
    for (std::uint32_t i = 0; i < distinct; ++i) points.push_back(drawPoint(engine));
    for (std::uint32_t i = 0; i < individuals; ++i) {
      where.push_back(places.placeOf(points[uniformIndex(engine, distinct)]));
    }
    census.take(where, places.size());
  }

  double delta(std::uint32_t i, std::uint32_t j) {
    return metric.distance(places.point(where[i]), places.point(where[j]));
  }
};

/// Holds the parts that runs of the genetic search on a pair of bodies share.
struct SearchedPair {
  PairScene scene;
  PairObjective objective;
  SearchWorkspace workspace;
  NicheRadii radii;
  explicit SearchedPair(PairScene made)
      : scene(std::move(made)),
        objective(*scene.a, *scene.b, scene.a_from_b),
        workspace(*scene.a, *scene.b),
        radii(automaticRadii(*scene.a, *scene.b, {})) {}
};

/// Where a descent without any memory ends.
inline TrialPoint descendAnew(const PairObjective& objective, const TrialPoint& point) {
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  return descend(objective, point, nullptr, trail, cost);
}

inline bool samePopulation(const std::vector<TrialPoint>& l, const std::vector<TrialPoint>& r) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(), [](const TrialPoint& x, const TrialPoint& y) {
    return samePlace(x, y) && x.squared_distance == y.squared_distance;
  });
}

/// How often each individual has been selected.
inline std::vector<std::uint32_t> countEach(const std::vector<std::uint32_t>& selected,
                                            std::size_t individuals) {
  std::vector<std::uint32_t> counts(individuals, 0);
  for (const std::uint32_t individual : selected) ++counts.at(individual);
  return counts;
}

}  // namespace concave_distance::test
