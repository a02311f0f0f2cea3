#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/expiry_queue.h"
#include "cone_comparison.h"
#include "dented_pairs.h"
#include "feature_slacks.h"
#include "minimum_slacks.h"
#include "sweep_lists.h"

namespace concave_distance::detail {

/// Opens pairs of cone groups, depth first, until what is left of them is kept, a minimum or undecided.
/// Writes to its lists, its queues and its limit alone.
class ConeSweep {
 public:
  /// @param slice_room pairs, after which it ends: for a slice, whose lists have all the room they get
  ConeSweep(const PairFrame& frame, ConeChoice choice, double cutoff, const MovedDistances& motion,
            SweepLists& lists, WorkLimit& limit, std::size_t slice_room = 0)
      : motion_(motion),
        features_(frame, cutoff),
        feature_slacks_(features_),
        minimum_slacks_(features_),
        cones_(frame, features_, choice.sides),
        dents_(frame, choice),
        offers_(motion),
        lists_(lists),
        limit_(limit),
        is_slice_(slice_room > 0),
        room_to_keep_(slice_room) {}

  /// Sends what is kept to queues at once instead of to SweepLists::kept.
  void keepIn(ExpiryQueues<SlotPair>& queues, WorkLimit& limit) {
    queues_ = &queues;
    queue_limit_ = &limit;
  }

  const NormalConeTree& conesOfA() const { return cones_.a; }
  const NormalConeTree& conesOfB() const { return cones_.b; }

  /// Goes through the open pairs and `expired`. Returns false when the limit was reached or no steps are
  /// left: the rest stays in both.
  bool run(ExpiredPairs& expired, std::size_t& steps) {
    std::vector<SlotPair>& open_pairs = lists_.open;
    for (; !open_pairs.empty() || !expired.empty(); --steps) {
      if (steps == 0 || limit_.isOverNow() || !hasRoom()) return false;
      if (open_pairs.empty()) {
        compare(expired);
        continue;
      }
      const SlotPair pair = open_pairs.back();
      open_pairs.pop_back();
      open(pair);
    }
    return true;
  }

  /// Opens in the order of the list until so many pairs are open, or none. Returns false when the limit was
  /// reached.
  bool widen(std::size_t count) {
    std::vector<SlotPair>& open_pairs = lists_.open;
    std::size_t opened = 0;
    bool has_room = true;
    while (opened < open_pairs.size() && open_pairs.size() - opened < count) {
      has_room = !limit_.isOverNow() && hasRoom();
      if (!has_room) break;
      const SlotPair pair = open_pairs[opened++];
      open(pair);
    }
    open_pairs.erase(open_pairs.begin(), open_pairs.begin() + static_cast<std::ptrdiff_t>(opened));
    return has_room;
  }

  /// Asks the live pairs of earlier poses: minima that stay are only measured. Returns false when the limit
  /// was reached.
  bool askLive() {
    if (!askUndecided()) return false;
    std::vector<LiveMinimum>& minima = lists_.minima;
    std::size_t rest = 0;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      if (limit_.isOverNow() || !limit_.admits(lists_.size() + 1)) {
        minima.erase(minima.begin() + static_cast<std::ptrdiff_t>(rest),
                     minima.begin() + static_cast<std::ptrdiff_t>(i));
        return false;
      }
      LiveMinimum& minimum = minima[i];
      const bool stays = minimum.moved_distance != MovedDistances::kNone &&
                         motion_.now(minimum.moved_distance) < minimum.expiry;
      if (stays) {
        measure(minimum);
      } else if (!isMinimum(minimum.pair, minimum)) {
        settle(minimum.pair);
        continue;
      }
      minima[rest++] = minimum;
    }
    minima.resize(rest);
    return true;
  }

 private:
  using Item = NormalConeTree::Item;
  using Slot = NormalConeTree::Slot;

  bool isFeaturePair(const SlotPair& pair) const {
    return ConeComparison::isItem(cones_.a.child(pair.first)) &&
           ConeComparison::isItem(cones_.b.child(pair.second));
  }
  const Item& itemOfA(Slot slot) const { return ConeComparison::itemOf(cones_.a, cones_.a.child(slot)); }
  const Item& itemOfB(Slot slot) const { return ConeComparison::itemOf(cones_.b, cones_.b.child(slot)); }

  template <typename T>
  static bool fits(const std::vector<T>& list, std::size_t more) {
    return list.size() + more <= list.capacity();
  }
  /// Returns whether the lists have room for one step.
  bool hasRoom() {
    constexpr std::size_t kWidth = ConeComparison::kWidth;
    if (!is_slice_) return limit_.admits(lists_.size() + kWidth);
    return room_to_keep_ >= kWidth && fits(lists_.open, kWidth) && fits(lists_.candidates, 1) &&
           fits(lists_.minima, 1) && fits(lists_.undecided, 1);
  }

  /// Compares the next pairs that have expired, without opening them.
  void compare(ExpiredPairs& expired) {
    constexpr std::size_t kAhead = 12;
    const auto left = static_cast<std::size_t>(expired.end - expired.next);
    const std::size_t size = std::min<std::size_t>(ConeComparison::kWidth, left);
    SlotPair pairs[ConeComparison::kWidth];
    for (std::size_t k = 0; k < ConeComparison::kWidth; ++k) pairs[k] = expired.next[std::min(k, size - 1)];
    for (std::size_t k = kAhead; k < std::min(kAhead + size, left); ++k) {
      cones_.prefetch(expired.next[k]);
    }
    const ConeReasons reasons = cones_.ofPairs(pairs);
    const ConeLanes excluded = reasons.largest();
    for (std::uint32_t lane = 0; lane < size; ++lane) {
      if (!(excluded[lane] > 0.0F) || !keepGroups(pairs[lane], reasons, lane, true)) {
        lists_.open.push_back(pairs[lane]);
      }
    }
    expired.next += size;
    lists_.groups += static_cast<std::uint32_t>(size);
  }

  void open(const SlotPair& pair) {
    if (isFeaturePair(pair)) {
      look(pair);
    } else {
      expand(pair);
    }
  }

  void expand(const SlotPair& pair) {
    ++lists_.groups;
    const auto [a, b] = pair;
    const bool opens_b = cones_.opensB(a, b);
    const std::uint32_t opened = opens_b ? cones_.b.child(b) : cones_.a.child(a);
    const ConeReasons reasons = opens_b ? cones_.withPartsOfB(a, opened) : cones_.withPartsOfA(opened, b);
    const ConeLanes excluded = reasons.largest();
    const NormalConeTree& tree = opens_b ? cones_.b : cones_.a;
    for (std::uint32_t lane = 0; lane < ConeComparison::kWidth; ++lane) {
      const Slot slot = opened + lane;
      if (tree.child(slot) == NormalConeTree::kNoChild) break;
      const SlotPair child{opens_b ? a : slot, opens_b ? slot : b};
      if (dents_.leavesOut(child)) continue;
      if (isFeaturePair(child) &&
          !FeaturePairs::isWanted(itemOfA(child.first).kind, itemOfB(child.second).kind)) {
        continue;
      }
      if (!(excluded[lane] > 0.0F) || !keepGroups(child, reasons, lane, opens_b)) {
        lists_.open.push_back(child);
      }
    }
  }

  void look(const SlotPair& pair) {
    LiveMinimum minimum;
    if (isMinimum(pair, minimum)) {
      lists_.minima.push_back(minimum);
    } else {
      settle(pair);
    }
  }

  /// Asks the undecided pairs once more; those that stay so go to the end of the list. Returns false when the
  /// limit was reached.
  bool askUndecided() {
    std::vector<SlotPair>& undecided = lists_.undecided;
    const std::size_t count = undecided.size();
    std::size_t asked = 0;
    while (asked < count && !limit_.isOverNow() && limit_.admits(lists_.size() + 1)) {
      const SlotPair pair = undecided[asked++];
      look(pair);
    }
    undecided.erase(undecided.begin(), undecided.begin() + static_cast<std::ptrdiff_t>(asked));
    return asked == count;
  }

  void measure(LiveMinimum& minimum) {
    ++lists_.measured;
    minimum.candidate =
        features_.moved(itemOfA(minimum.pair.first), itemOfB(minimum.pair.second), minimum.candidate);
    lists_.candidates.push_back(minimum.candidate);
  }

  bool isMinimum(const SlotPair& pair, LiveMinimum& minimum) {
    ++lists_.features;
    const Item& a = itemOfA(pair.first);
    const Item& b = itemOfB(pair.second);
    const auto found = features_.findMinimum(a, b);
    if (!found) return false;
    lists_.candidates.push_back(*found);
    resetOffers(pair);
    const bool stays = minimum_slacks_.offer(a, b, *found, offers_);
    minimum = {pair, offers_.movedDistance(), stays ? offers_.expiry() : 0, *found};
    return true;
  }

  /// Keeps a pair of features that holds no minimum.
  void settle(const SlotPair& pair) {
    if (!keepFeatures(pair)) lists_.undecided.push_back(pair);
  }

  /// Returns false for what has no slack, and without room.
  bool keepFeatures(const SlotPair& pair) {
    resetOffers(pair);
    feature_slacks_.offer(itemOfA(pair.first), itemOfB(pair.second), offers_);
    return !offers_.empty() && keep(pair);
  }

  /// Returns false for what has no slack, and without room. An offer that is hardly above 0 may be none.
  bool keepGroups(const SlotPair& pair, const ConeReasons& reasons, std::uint32_t lane, bool kept_is_a) {
    resetOffers(pair);
    const double unit = (kept_is_a ? cones_.b : cones_.a).unit();
    const Side kept = kept_is_a ? Side::A : Side::B;
    const Side other = kept_is_a ? Side::B : Side::A;
    offers_.offerTurn(static_cast<double>(reasons.turned_away[lane]));
    const double too_far = static_cast<double>(reasons.too_far[lane]) * unit;
    offers_.offerMotion(other, std::max(too_far, static_cast<double>(reasons.misses_kept[lane]) * unit));
    offers_.offerMotion(kept, std::max(too_far, static_cast<double>(reasons.misses_other[lane]) * unit));
    return !offers_.empty() && keep(pair);
  }

  /// Returns false without room.
  bool keep(const SlotPair& pair) {
    const std::uint32_t moved_distance = offers_.movedDistance();
    const std::uint64_t expiry = std::max(offers_.expiry(), motion_.now(moved_distance) + 1);
    --room_to_keep_;
    if (queues_ != nullptr && queues_->insert(moved_distance, expiry, pair, *queue_limit_)) return true;
    if (lists_.kept.size() == lists_.kept.capacity()) return false;
    lists_.kept.push_back({pair, moved_distance, expiry});
    return true;
  }

  void resetOffers(const SlotPair& pair) {
    offers_.reset(cones_.a.subtreeOf(pair.first), cones_.b.subtreeOf(pair.second));
  }

  const MovedDistances& motion_;
  FeaturePairs features_;
  FeatureSlacks feature_slacks_;
  MinimumSlacks minimum_slacks_;
  ConeComparison cones_;
  DentedPairs dents_;
  SlackOffers offers_;
  SweepLists& lists_;
  WorkLimit& limit_;
  bool is_slice_;
  std::size_t room_to_keep_;
  ExpiryQueues<SlotPair>* queues_ = nullptr;
  WorkLimit* queue_limit_ = nullptr;
};

}  // namespace concave_distance::detail
