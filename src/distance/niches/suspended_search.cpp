#include "suspended_search.h"

#include <limits>

#include "decision_basins.h"
#include "decision_paths.h"

namespace concave_distance::detail {

void SuspendedSearch::suspend(BasinSearch& search, const TrianglePair& start, const PairFrame& frame) {
  std::swap(search_, search);
  began_.emplace(Began{start, frame});
  kept_ = {};
}

void SuspendedSearch::clear() {
  began_.reset();
}

// Minima of equal depth do not end it: the basin belongs to the first candidate in it, at each pose.
bool SuspendedSearch::goOn(DecisionCache& memory, WorkLimit& limit) {
  if (!began_) return true;
  const auto never = [](TriangleIndex, TriangleIndex) { return false; };
  const std::size_t before = search_.lookedAt();
  const BasinSearch::End end =
      search_.proceed(began_->frame, std::numeric_limits<std::size_t>::max(), never, never, limit);
  visited_ += static_cast<std::uint32_t>(search_.lookedAt() - before);
  bool is_over = limit.hasRefusedPairs();
  if (end == BasinSearch::End::Enclosed) {
    DecisionCounts counts;
    DecisionBasins(memory, search_, began_->frame, counts, limit).keepSome(began_->start, kept_);
    is_over = kept_.is_over;
  } else if (end != BasinSearch::End::Cut) {
    keepPath(memory, end == BasinSearch::End::Below, limit);
    is_over = true;
  }
  if (is_over) began_.reset();
  return is_over;
}

void SuspendedSearch::keepPath(DecisionCache& memory, bool is_below, WorkLimit& limit) const {
  const std::uint32_t number = memory.facetPairOf(began_->start.a, began_->start.b, limit);
  if (number == DecisionCache::kNone) return;
  DecisionCounts counts;
  DecisionPaths paths(memory, began_->frame, counts, limit);
  paths.keepPath(search_, number);
  const BasinSearch::FacetPair& last = search_.facet_pairs()[search_.last()];
  if (is_below) paths.keepLow({last.a, last.b});
}

}  // namespace concave_distance::detail
