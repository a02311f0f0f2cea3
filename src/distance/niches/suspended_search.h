#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "basin_search.h"
#include "decision_cache.h"
#include "decision_counts.h"

namespace concave_distance::detail {

/// Keeps a long search that time has ended. It goes on at the pose where it began; what it finds is put into
/// the memory, step by step, and is evidence of an earlier pose like any other (doc/proofs.md).
class SuspendedSearch {
 public:
  /// Takes a search over, with the facet pair and the pose where it began.
  void suspend(BasinSearch& search, const TrianglePair& start, const PairFrame& frame);
  bool isThere() const { return began_.has_value(); }

  /// Goes on, between two poses: no candidate is in the memory. Returns false when the limit has ended it
  /// before all it finds is kept.
  bool goOn(DecisionCache& memory, WorkLimit& limit);
  /// Forgets it together with all that is in the memory.
  void clear();

  /// Returns the facet pairs looked at since the last call.
  std::uint32_t takeVisited() { return std::exchange(visited_, 0); }

 private:
  struct Began {
    TrianglePair start;  ///< facet pair
    PairFrame frame;
  };

  void keepPath(DecisionCache& memory, bool is_below, WorkLimit& limit) const;

  BasinSearch search_;
  std::optional<Began> began_;
  BasinProgress kept_;
  std::uint32_t visited_ = 0;
};

}  // namespace concave_distance::detail
