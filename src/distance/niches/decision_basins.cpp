#include "decision_basins.h"

#include <cmath>

namespace concave_distance::detail {
namespace {

/// Around more facet pairs no boundary is kept.
constexpr std::size_t kLargestBasin = std::size_t{1} << 18U;

}  // namespace

bool DecisionBasins::takeCrossed(std::uint32_t index, double level) {
  counts_.measured += memory_.basin(index).boundary.takeCrossed(memory_.boundaries(), frame_, level);
  if (!memory_.boundaries().crossed.empty()) return true;
  ++counts_.by_boundary;
  return false;
}

void DecisionBasins::restoreBoundary(std::uint32_t index) {
  for (const BoundaryElement& element : memory_.boundaries().crossed) {
    if (!memory_.basin(index).boundary.add(memory_.boundaries(), frame_, element, 0.0, limit_)) {
      return memory_.drop(index);
    }
  }
}

std::uint64_t DecisionBasins::keep(std::uint64_t id, std::uint32_t first, const TrianglePair& around) {
  const std::size_t size = search_.facet_pairs().size();
  if (size > kLargestBasin) return 0;
  const std::uint32_t index = memory_.takeBasin(id, limit_);
  if (index == DecisionCache::kNone) return 0;
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  basin.confirmed = true;
  basin.first = first;
  basin.facet_pairs_at_begin = size;
  const TrianglePairDistance closest =
      triangleDistance(frame_.cornersOfA(around.a), frame_.cornersOfB(around.b));
  basin.boundary.begin(memory_.boundaries(), closest.point_a, frame_.pointInB(closest.point_b));
  return extend(index) ? basin.id : 0;
}

bool DecisionBasins::extend(std::uint32_t index) {
  if (add(index)) return true;
  memory_.drop(index);
  return false;
}

bool DecisionBasins::add(std::uint32_t index) {
  DecisionCache::KeptBasin& basin = memory_.basin(index);
  for (const BasinSearch::FacetPair& facet_pair : search_.facet_pairs()) {
    const std::uint32_t number = memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
    if (number == DecisionCache::kNone || !memory_.join(number, index, limit_)) return false;
  }
  bool has_room = true;
  search_.forEachBoundaryStep(
      [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); },
      [&](const BasinSearch::BoundaryStep& step) {
        const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
        has_room = has_room && basin.boundary.add(memory_.boundaries(), frame_, {step.element, beyond},
                                                  std::sqrt(step.squared_level), limit_);
      });
  return has_room;
}

}  // namespace concave_distance::detail
