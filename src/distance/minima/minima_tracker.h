#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/expiry_queue.h"
#include "cone_slices.h"
#include "dented_pairs.h"
#include "distance/kernels/pair_frame.h"
#include "moved_distances.h"
#include "sweep_lists.h"

namespace concave_distance::detail {

/// Keeps what the last pose of a pair leaves to be looked at in the next one: every pair of cone groups, or
/// of features, that holds no local minimum is kept with the motion that it stays so for. At every instant
/// each pair of features has exactly one ancestor that is kept, or is live. Belongs to one pair of bodies,
/// one cutoff and one choice of cones.
class MinimaTracker {
 public:
  /// Counts what one call did.
  struct Counts {
    std::uint32_t expired = 0;    ///< kept pairs whose slack was used up
    std::uint32_t groups = 0;     ///< comparisons of a group with four others
    std::uint32_t features = 0;   ///< pairs of features that were asked whether they hold a minimum
    std::uint32_t measured = 0;   ///< minima that have stayed
    std::uint32_t kept = 0;       ///< pairs, at the end
    std::uint32_t live = 0;       ///< features that hold a minimum or may do so at the next pose
    std::uint32_t undecided = 0;  ///< of the live ones, those that hold none
    std::uint32_t slices = 0;     ///< that idle threads could look at
    bool began_anew = false;

    std::size_t comparisons() const { return std::size_t{groups} + features; }
  };

  /// @param sliced_from expired pairs from which on they are looked at in slices
  explicit MinimaTracker(std::size_t sliced_from = ConeSlices::kManyExpired) : sliced_from_(sliced_from) {}

  /// Lets the next call begin at the roots; it knows nothing of the motion.
  void clear() {
    valid_ = false;
    motion_.forgetRates();
  }

  /// Appends at least one triangle pair of every local minimum between 0 and `cutoff` (metres).
  /// @param most_comparisons after which it ends, too
  /// @return false when the limit was reached: minima may be missing, and the next call goes on
  bool collect(const PairFrame& frame, ConeChoice choice, double cutoff,
               std::vector<MinimumCandidate>& candidates, WorkLimit& limit,
               std::size_t most_comparisons = std::numeric_limits<std::size_t>::max());
  /// Returns whether it has grown so much since it was begun that it looks at needlessly small groups.
  bool hasOutgrown() const { return hasGrown(kLargeGrowth); }

  const Counts& counts() const { return counts_; }

  /// Calls visit(slot of A, slot of B) for everything that is kept or live: what a test of completeness looks
  /// at.
  template <typename Visit>
  void forEachPair(const Visit& visit) const {
    queues_.forEach([&](const SlotPair& pair) { visit(pair.first, pair.second); });
    for (const LiveMinimum& minimum : lists_.minima) visit(minimum.pair.first, minimum.pair.second);
    for (const auto& [a, b] : lists_.undecided) visit(a, b);
    for (const auto& [a, b] : lists_.open) visit(a, b);
    for (std::size_t i = next_expired_; i < expired_.size(); ++i)
      visit(expired_[i].first, expired_[i].second);
  }

 private:
  class Stage;
  void count();
  bool hasGrown(std::size_t factor) const {
    return kept_at_begin_ != 0 && queues_.size() > factor * kept_at_begin_ + kSmallGrowth;
  }

  static constexpr std::size_t kLargeGrowth = 3;
  /// A front that has grown by this factor is begun anew at once.
  static constexpr std::size_t kLargestGrowth = 16;
  static constexpr std::size_t kSmallGrowth = 256;  ///< of the smallest, pairs

  std::size_t sliced_from_;
  MovedDistances motion_;
  ExpiryQueues<SlotPair> queues_;  ///< one for each moved distance
  SweepLists lists_;
  ConeSlices slices_;
  std::vector<SlotPair> expired_;  ///< to be compared, from next_expired_ on
  std::size_t next_expired_ = 0;
  std::size_t kept_at_begin_ = 0;
  bool valid_ = false;
  double cutoff_ = 0.0;
  ConeChoice choice_;
  Counts counts_;
};

}  // namespace concave_distance::detail
