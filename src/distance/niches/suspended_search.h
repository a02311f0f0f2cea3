#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "basin_search.h"
#include "decision_cache.h"
#include "decision_counts.h"

namespace concave_distance::detail {

class DecisionPaths;

/// Keeps a long search that time has ended. It goes on at the pose where it began; what it finds is put into
/// the memory with that pose, to be looked at anew at the present one.
class SuspendedSearch {
 public:
  /// Takes the search over, with the facet pair and the pose where it began.
  void suspend(BasinSearch& search, const TrianglePair& start, const PairFrame& frame);
  void forget() { began_.reset(); }
  bool isThere() const { return began_.has_value(); }
  const TrianglePair& start() const { return began_->start; }

  /// Goes on to the search's end or to that of the limit.
  /// @param meets as in BasinSearch::proceed()
  template <typename Meets>
  BasinSearch::End proceed(const Meets& meets, DecisionCounts& counts, WorkLimit& limit) {
    const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
    const std::size_t before = search_.lookedAt();
    const BasinSearch::End end =
        search_.proceed(began_->frame, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit);
    has_grown_ = search_.lookedAt() > before;
    counts.visited_pairs += static_cast<std::uint32_t>(search_.lookedAt() - before);
    return end;
  }
  /// Returns the facet pairs that all of the search has looked at; 0 where the last proceed() had none left.
  std::size_t lookedAt() const { return has_grown_ ? search_.lookedAt() : 0; }

  /// Keeps the basin that was found enclosed, around candidate i of the present pose.
  void keepBasin(DecisionCache& memory, std::uint32_t i, const MinimumCandidate& candidate,
                 DecisionCounts& counts, WorkLimit& limit);
  /// Keeps the path to where the search has ended.
  void keepPath(DecisionCache& memory, DecisionPaths& paths, bool is_below, WorkLimit& limit);

  std::size_t memoryBytes() const { return search_.memoryBytes(); }

 private:
  struct Began {
    TrianglePair start;  ///< facet pair
    PairFrame frame;
  };
  BasinSearch search_;
  std::optional<Began> began_;
  bool has_grown_ = false;
};

}  // namespace concave_distance::detail
