#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "search/automatic_radii.h"
#include "search/local_descent.h"
#include "search/search_scenes.h"
#include "search/search_workspace.h"

namespace concave_distance::test {

/// What runs of the genetic search on a pair of bodies share.
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

}  // namespace concave_distance::test
