#include "decision_paths.h"

namespace concave_distance::detail {

bool DecisionPaths::comesBelow(std::uint32_t number, double below) {
  const DecisionCache::FacetPair& facet_pair = memory_.facet_pair(number);
  const std::uint32_t low = facet_pair.low;
  if (low == kNone) return false;
  const bool is_below = squaredLevelOf(memory_.link(low)) < below * below ||
                        (facet_pair.link == kNone &&
                         aim(low, frame_.closestIn({facet_pair.a, facet_pair.b}).second) < below * below);
  if (is_below) memory_.use(low);
  return is_below;
}

double DecisionPaths::aim(std::uint32_t link, const TrianglePairDistance& closest) {
  ++counts_.aimed;
  memory_.aim(link, closest.point_a, frame_.pointInB(closest.point_b));
  return closest.squared_distance;
}

void DecisionPaths::keepPath(const BasinSearch& search, std::uint32_t start) {
  const std::vector<BasinSearch::FacetPair>& visited = search.facet_pairs();
  std::uint32_t at = search.last();
  std::uint32_t next = memory_.facetPairOf(visited[at].a, visited[at].b, limit_);
  while (next != kNone && visited[at].parent != BasinSearch::kNone) {
    const BasinSearch::FacetPair& here = visited[at];
    const std::uint32_t before =
        here.parent == 0 ? start
                         : memory_.facetPairOf(visited[here.parent].a, visited[here.parent].b, limit_);
    if (before == kNone) return;
    keepLink(memory_.facet_pair(before).link, closestOver(frame_, here.via), next, here.via);
    next = before;
    at = here.parent;
  }
}

void DecisionPaths::keepLow(const TrianglePair& facet_pair) {
  const std::uint32_t number = memory_.facetPairOf(facet_pair.a, facet_pair.b, limit_);
  if (number == kNone) return;
  keepLink(memory_.facet_pair(number).low, frame_.closestIn(facet_pair).second, number, {});
}

void DecisionPaths::keepLink(std::uint32_t& link, const TrianglePairDistance& closest, std::uint32_t next,
                             const SharedElement& via) {
  memory_.keepLink(link, {closest.point_a, frame_.pointInB(closest.point_b), next, via});
}

}  // namespace concave_distance::detail
