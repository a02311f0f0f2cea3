#include "suspended_search.h"

#include <algorithm>
#include <utility>

#include "decision_basins.h"
#include "decision_paths.h"

namespace concave_distance::detail {

void SuspendedSearch::suspend(BasinSearch& search, const TrianglePair& start, const PairFrame& frame) {
  std::swap(search_, search);
  began_.emplace(Began{start, frame});
}

void SuspendedSearch::keepBasin(DecisionCache& memory, std::uint32_t i, const MinimumCandidate& candidate,
                                DecisionCounts& counts, WorkLimit& limit) {
  DecisionBasins basins(memory, search_, began_->frame, counts, limit);
  const std::uint32_t known = memory.basinWith(basins.keep(0, i, {candidate.a, candidate.b}));
  if (known == DecisionCache::kNone) return;
  // The search has met no earlier candidate where they were then; now one may be inside.
  for (const BasinSearch::FacetPair& facet_pair : search_.facet_pairs()) {
    memory.basin(known).first =
        std::min(memory.basin(known).first, memory.candidateIn(facet_pair.a, facet_pair.b));
  }
}

void SuspendedSearch::keepPath(DecisionCache& memory, DecisionPaths& paths, bool is_below, WorkLimit& limit) {
  const std::uint32_t number = memory.facetPairOf(began_->start.a, began_->start.b, limit);
  if (number == DecisionCache::kNone) return;
  paths.keepPath(search_, number);
  const BasinSearch::FacetPair& last = search_.facet_pairs()[search_.last()];
  if (is_below) paths.keepLow({last.a, last.b});
}

}  // namespace concave_distance::detail
