#include "cone_front.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

using Item = NormalConeTree::Item;

/// A front that has grown by this factor since it was begun is begun anew: it looks at needlessly small
/// groups.
constexpr std::uint32_t kLargestGrowth = 2;
constexpr std::uint32_t kSmallGrowth = 256;  // of the smallest, pairs

}  // namespace

/// One call of collect().
class ConeFront::Stage {
 public:
  Stage(ConeFront& front, const MinimaScene& scene, NormalSides sides, double cutoff,
        std::vector<MinimumSeed>& seeds, WorkLimit& limit)
      : front_(front),
        features_(scene, cutoff),
        cones_(scene, features_, sides),
        offers_(front.motion_),
        seeds_(seeds),
        limit_(limit) {}

  bool isEmpty() const { return cones_.a.empty() || cones_.b.empty(); }

  void begin(const MinimaScene& scene) {
    front_.counts_.began_anew = true;
    front_.motion_.begin(cones_.a, cones_.b, scene.frames, scene.size);
    front_.pool_.clear();
    front_.free_ = ExpiryQueue<Entry>::kEnd;
    front_.queues_.resize(front_.motion_.clockCount());
    for (ExpiryQueue<Entry>& queue : front_.queues_) queue.clear();
    front_.live_.clear();
    front_.open_.assign(1, {NormalConeTree::kRoot, NormalConeTree::kRoot});
    front_.kept_ = 0;
    front_.valid_ = true;
  }

  /// What has expired is taken out and is open again.
  void expire() {
    for (std::uint32_t clock = 0; clock < front_.queues_.size(); ++clock) {
      front_.queues_[clock].advance(front_.pool_, front_.motion_.now(clock), [&](std::uint32_t index) {
        Entry& entry = front_.pool_[index];
        front_.open_.emplace_back(entry.a, entry.b);
        entry.expiry = kFree;
        entry.next = front_.free_;
        front_.free_ = index;
        ++front_.counts_.expired;
        --front_.kept_;
      });
    }
  }

  bool run() {
    std::vector<Pair>& open = front_.open_;
    // Pairs that have expired are compared as they are, not opened at once.
    for (std::size_t i = front_.counts_.began_anew ? 0 : open.size(); i-- > 0;) {
      if (limit_.isOverNow()) return false;
      if (!isExcluded(open[i])) continue;
      open[i] = open.back();
      open.pop_back();
    }
    while (!open.empty()) {
      if (limit_.isOverNow()) return false;
      if (!limit_.makeRoom(open, ConeComparison::kWidth) || !limit_.makeRoom(seeds_)) return false;
      const Pair pair = open.back();
      open.pop_back();
      if (isFeaturePair(pair)) {
        look(pair);
      } else {
        expand(pair);
      }
    }
    return true;
  }

  /// Asks the live pairs of earlier poses.
  bool askLive() {
    std::vector<Pair>& live = front_.live_;
    std::size_t rest = 0;
    for (std::size_t i = 0; i < live.size(); ++i) {
      const Pair pair = live[i];
      if (limit_.isOverNow() || !limit_.makeRoom(seeds_)) {
        while (i < live.size()) live[rest++] = live[i++];
        live.resize(rest);
        return false;
      }
      if (!settles(pair)) live[rest++] = pair;
    }
    live.resize(rest);
    return true;
  }

 private:
  bool isFeaturePair(const Pair& pair) const {
    return ConeComparison::isItem(cones_.a.child(pair.first)) &&
           ConeComparison::isItem(cones_.b.child(pair.second));
  }
  const Item& itemOfA(Slot slot) const { return ConeComparison::itemOf(cones_.a, cones_.a.child(slot)); }
  const Item& itemOfB(Slot slot) const { return ConeComparison::itemOf(cones_.b, cones_.b.child(slot)); }

  bool isExcluded(const Pair& pair) {
    ++front_.counts_.groups;
    const std::uint32_t node = pair.second / ConeComparison::kWidth;
    const std::uint32_t lane = pair.second % ConeComparison::kWidth;
    const ConeReasons reasons = cones_.withNodeOfB(pair.first, node);
    if (!(reasons.largest()[lane] > 0.0F)) return false;
    keepGroups(pair, reasons, lane, true);
    return true;
  }

  void expand(const Pair& pair) {
    ++front_.counts_.groups;
    const auto [a, b] = pair;
    const bool opens_b = cones_.opensB(a, b);
    const std::uint32_t opened = opens_b ? cones_.b.child(b) : cones_.a.child(a);
    const ConeReasons reasons = opens_b ? cones_.withNodeOfB(a, opened) : cones_.withNodeOfA(opened, b);
    const ConeLanes excluded = reasons.largest();
    const NormalConeTree::Node& node = (opens_b ? cones_.b : cones_.a).nodes()[opened];
    for (std::uint32_t lane = 0;
         lane < ConeComparison::kWidth && node.child[lane] != NormalConeTree::kNoChild; ++lane) {
      const Slot slot = opened * ConeComparison::kWidth + lane;
      const Pair child{opens_b ? a : slot, opens_b ? slot : b};
      if (isFeaturePair(child) &&
          !FeaturePairs::isWanted(itemOfA(child.first).kind, itemOfB(child.second).kind)) {
        continue;
      }
      if (excluded[lane] > 0.0F) {
        keepGroups(child, reasons, lane, opens_b);
      } else {
        front_.open_.push_back(child);
      }
    }
  }

  void look(const Pair& pair) {
    if (!settles(pair)) front_.live_.push_back(pair);
  }

  /// False for a pair of features that is a minimum or has no slack.
  bool settles(const Pair& pair) {
    ++front_.counts_.features;
    const Item& a = itemOfA(pair.first);
    const Item& b = itemOfB(pair.second);
    if (const auto found = features_.findMinimum(a, b)) {
      seeds_.push_back(*found);
      return false;
    }
    resetOffers(pair);
    features_.offerSlacks(a, b, offers_);
    return !offers_.empty() && keep(pair);
  }

  void resetOffers(const Pair& pair) {
    offers_.reset(cones_.a.regionOf(pair.first), cones_.b.regionOf(pair.second));
  }

  void keepGroups(const Pair& pair, const ConeReasons& reasons, std::uint32_t lane, bool node_is_b) {
    resetOffers(pair);
    const double unit = (node_is_b ? cones_.b : cones_.a).unit();
    const Side of_node = node_is_b ? Side::B : Side::A;
    const Side kept = node_is_b ? Side::A : Side::B;
    offers_.offerTurn(static_cast<double>(reasons.turned_away[lane]));
    const double too_far = static_cast<double>(reasons.too_far[lane]) * unit;
    offers_.offerMotion(of_node, std::max(too_far, static_cast<double>(reasons.misses_kept[lane]) * unit));
    offers_.offerMotion(kept, std::max(too_far, static_cast<double>(reasons.misses_node[lane]) * unit));
    // An offer that is hardly above 0 may be none: then the pair is asked again after any motion.
    if (offers_.empty() || !keep(pair)) front_.open_.push_back(pair);
  }

  /// False without memory.
  bool keep(const Pair& pair) {
    std::uint32_t index = front_.free_;
    if (index != ExpiryQueue<Entry>::kEnd) {
      front_.free_ = front_.pool_[index].next;
    } else {
      if (!limit_.makeRoom(front_.pool_)) return false;
      index = static_cast<std::uint32_t>(front_.pool_.size());
      front_.pool_.emplace_back();
    }
    const std::uint32_t clock = offers_.clock();
    front_.pool_[index] = {std::max(offers_.expiry(), front_.motion_.now(clock) + 1), pair.first, pair.second,
                           0};
    front_.queues_[clock].insert(front_.pool_, index);
    ++front_.kept_;
    return true;
  }

  ConeFront& front_;
  FeaturePairs features_;
  ConeComparison cones_;
  SlackOffers offers_;
  std::vector<MinimumSeed>& seeds_;
  WorkLimit& limit_;
};

bool ConeFront::collect(const MinimaScene& scene, NormalSides sides, double cutoff,
                        std::vector<MinimumSeed>& seeds, WorkLimit& limit) {
  counts_ = {};
  Stage stage(*this, scene, sides, cutoff, seeds, limit);
  if (stage.isEmpty()) return true;
  valid_ = valid_ && cutoff == cutoff_ && sides == sides_ && motion_.advance(scene.frames);
  cutoff_ = cutoff;
  sides_ = sides;
  bool done = true;
  if (!valid_) {
    stage.begin(scene);
    done = stage.run();
    kept_at_begin_ = 0;
  } else {
    done = stage.askLive();
    stage.expire();
    done = stage.run() && done;
  }
  // What a limit has ended grows until it is whole.
  if (kept_at_begin_ == 0) {
    kept_at_begin_ = done ? kept_ : 0;
  } else if (kept_ > kLargestGrowth * kept_at_begin_ + kSmallGrowth) {
    valid_ = false;
  }
  counts_.kept = kept_;
  counts_.live = static_cast<std::uint32_t>(live_.size());
  return done;
}

std::size_t ConeFront::memoryBytes() const {
  return pool_.capacity() * sizeof(Entry) + queues_.capacity() * sizeof(queues_[0]) +
         (live_.capacity() + open_.capacity()) * sizeof(Pair);
}

}  // namespace concave_distance::detail
