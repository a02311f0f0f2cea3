#include "decision_basins.h"

#include <cmath>

namespace concave_distance::detail {
namespace {

/// Around more facet pairs no boundary is kept.
constexpr std::size_t kLargestBasin = std::size_t{1} << 18U;

}  // namespace

bool DecisionBasins::takeCrossed(std::uint32_t index, double level) {
  BoundaryPool& pool = memory_.boundaries();
  counts_.measured += memory_.basin(index).boundary.takeCrossed(pool, frame_, level, limit_);
  if (!pool.crossed.empty() || pool.has_unmeasured) return true;
  ++counts_.by_boundary;
  return false;
}

void DecisionBasins::restoreBoundary(std::uint32_t index) {
  for (const BoundaryElement& element : memory_.boundaries().crossed) {
    const TrianglePair beyond = element.pairBeyond();
    if (memory_.isIn(beyond.a, beyond.b, index)) continue;
    memory_.basin(index).boundary.add(memory_.boundaries(), frame_, element, 0.0);
  }
}

std::uint64_t DecisionBasins::keep(std::uint64_t id, std::uint32_t first, const TrianglePair& around) {
  const std::uint32_t index = begin(id, around);
  if (index == DecisionCache::kNone || !extend(index)) return 0;
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  basin.is_whole = basin.confirmed = true;
  basin.first = first;
  return basin.id;
}

void DecisionBasins::keepSome(const TrianglePair& around, Progress& progress) {
  if (progress.basin == DecisionCache::kNone) progress.basin = begin(0, around);
  progress.is_over = progress.basin == DecisionCache::kNone;
  while (!progress.is_over && !isAdded(progress)) {
    if (limit_.isOverNow()) return;
    progress.is_over = !addNext(progress);
  }
  if (progress.basin == DecisionCache::kNone) return;
  if (progress.is_over) {
    memory_.drop(progress.basin);
    return;
  }
  progress.is_over = true;
  DecisionCache::KeptBasin& basin = memory_.basin(progress.basin);
  basin.is_whole = basin.confirmed = true;
}

std::uint32_t DecisionBasins::begin(std::uint64_t id, const TrianglePair& around) {
  const std::size_t size = search_.facet_pairs().size();
  if (size > kLargestBasin) return DecisionCache::kNone;
  const std::uint32_t index = memory_.takeBasin(id);
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  basin.facet_pairs_at_begin = size;
  const TrianglePairDistance closest =
      triangleDistance(frame_.cornersOfA(around.a), frame_.cornersOfB(around.b));
  basin.boundary.begin(memory_.boundaries(), closest.point_a, frame_.pointInB(closest.point_b));
  return index;
}

bool DecisionBasins::extend(std::uint32_t index) {
  Progress progress;
  progress.basin = index;
  while (!isAdded(progress)) {
    if (addNext(progress)) continue;
    memory_.drop(index);
    return false;
  }
  return true;
}

void DecisionBasins::extendPartly(std::uint32_t index) {
  search_.findReached(is_reached_);
  const std::vector<BasinSearch::FacetPair>& visited = search_.facet_pairs();
  bool has_room = true;
  for (std::size_t i = 0; i < visited.size() && has_room; ++i) {
    if (is_reached_[i] != 0) continue;
    const std::uint32_t number = memory_.facetPairOf(visited[i].a, visited[i].b, limit_);
    has_room = number != DecisionCache::kNone && memory_.join(number, index, limit_);
    if (has_room) partFromReached({visited[i].a, visited[i].b}, index);
  }
  Progress progress;
  progress.basin = index;
  progress.facet_pairs = visited.size();
  while (has_room && !isAdded(progress)) has_room = addNext(progress);
  if (!has_room) {
    memory_.drop(index);
    return;
  }
  restoreBoundary(index);
}

void DecisionBasins::partFromReached(const TrianglePair& pair, std::uint32_t index) {
  BasinBoundary& boundary = memory_.basin(index).boundary;
  const auto part = [&](TriangleIndex a, TriangleIndex b, const BoundaryElement& element) {
    const std::uint32_t beyond = search_.indexOf(a, b);
    if (beyond == BasinSearch::kNone || is_reached_[beyond] == 0) return;
    boundary.add(memory_.boundaries(), frame_, element, 0.0);
  };
  for (const AdjacentTriangle& next : frame_.adjacency_a->row(pair.a.value)) {
    part(next.triangle, pair.b, {{Side::A, next.from, next.to, pair.b}, next.triangle});
  }
  for (const AdjacentTriangle& next : frame_.adjacency_b->row(pair.b.value)) {
    part(pair.a, next.triangle, {{Side::B, next.from, next.to, pair.a}, next.triangle});
  }
}

bool DecisionBasins::addNext(Progress& progress) {
  const std::uint32_t index = progress.basin;
  if (progress.facet_pairs < search_.facet_pairs().size()) {
    const BasinSearch::FacetPair& facet_pair = search_.facet_pairs()[progress.facet_pairs++];
    const std::uint32_t number = memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
    return number != DecisionCache::kNone && memory_.join(number, index, limit_);
  }
  const BasinSearch::BoundaryStep& step = search_.boundarySteps()[progress.boundary_steps++];
  if (!search_.isBeyond(step) || memory_.isIn(step.beyond_a, step.beyond_b, index)) return true;
  const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
  memory_.basin(index).boundary.add(memory_.boundaries(), frame_, {step.element, beyond},
                                    std::sqrt(step.squared_level));
  return true;
}

}  // namespace concave_distance::detail
