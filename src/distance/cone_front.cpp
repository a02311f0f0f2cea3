#include "cone_front.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

using Item = NormalConeTree::Item;

/// A front that has grown by this factor since it was begun is begun anew: it looks at needlessly small
/// groups.
constexpr std::size_t kLargestGrowth = 2;
constexpr std::size_t kUsualMinima = 64;
constexpr std::size_t kUsualExpired = 1024;
constexpr std::size_t kSmallGrowth = 256;  // of the smallest, pairs

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
    front_.queues_.begin(front_.motion_.clockCount());
    front_.minima_.clear();
    front_.undecided_.clear();
    // What most pairs never outgrow.
    front_.minima_.reserve(kUsualMinima);
    front_.undecided_.reserve(kUsualMinima);
    front_.open_.reserve(kUsualMinima);
    front_.expired_.reserve(kUsualExpired);
    front_.expired_.clear();
    front_.next_expired_ = 0;
    front_.open_.assign(1, {NormalConeTree::kRoot, NormalConeTree::kRoot});
    front_.valid_ = true;
  }

  /// Appends what has expired to what earlier cycles have left.
  void expire() {
    std::vector<Pair>& expired = front_.expired_;
    expired.erase(expired.begin(), expired.begin() + static_cast<std::ptrdiff_t>(front_.next_expired_));
    front_.next_expired_ = 0;
    const std::size_t before = front_.queues_.size();
    const auto take = [&](const Pair& pair) { expired.push_back(pair); };
    for (std::uint32_t clock = 0; clock < front_.motion_.clockCount(); ++clock) {
      front_.queues_.advance(clock, front_.motion_.now(clock), take, limit_);
    }
    front_.counts_.expired = static_cast<std::uint32_t>(before - front_.queues_.size());
  }

  /// Compares what has expired and opens what is excluded no more. False when the limit was reached.
  bool run() {
    std::vector<Pair>& open = front_.open_;
    while (!open.empty() || front_.next_expired_ < front_.expired_.size()) {
      if (limit_.isOverNow()) return false;
      if (!limit_.makeRoom(open, ConeComparison::kWidth) || !limit_.makeRoom(seeds_)) return false;
      if (open.empty()) {
        compareExpired();
        continue;
      }
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

  /// Asks the live pairs of earlier poses: minima that stay are only measured. False when the limit was
  /// reached.
  bool askLive() {
    if (!askUndecided()) return false;
    std::vector<Minimum>& minima = front_.minima_;
    std::size_t rest = 0;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      if (limit_.isOverNow() || !limit_.makeRoom(seeds_)) {
        minima.erase(minima.begin() + static_cast<std::ptrdiff_t>(rest),
                     minima.begin() + static_cast<std::ptrdiff_t>(i));
        return false;
      }
      Minimum& minimum = minima[i];
      const bool stays =
          minimum.clock != ConeMotion::kNoClock && front_.motion_.now(minimum.clock) < minimum.expiry;
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
  bool isFeaturePair(const Pair& pair) const {
    return ConeComparison::isItem(cones_.a.child(pair.first)) &&
           ConeComparison::isItem(cones_.b.child(pair.second));
  }
  const Item& itemOfA(Slot slot) const { return ConeComparison::itemOf(cones_.a, cones_.a.child(slot)); }
  const Item& itemOfB(Slot slot) const { return ConeComparison::itemOf(cones_.b, cones_.b.child(slot)); }

  /// The next pairs that have expired, as they are.
  void compareExpired() {
    constexpr std::size_t kAhead = 12;
    const std::vector<Pair>& expired = front_.expired_;
    const std::size_t first = front_.next_expired_;
    const std::size_t size = std::min<std::size_t>(ConeComparison::kWidth, expired.size() - first);
    Pair pairs[ConeComparison::kWidth];
    for (std::size_t k = 0; k < ConeComparison::kWidth; ++k)
      pairs[k] = expired[first + std::min(k, size - 1)];
    for (std::size_t k = first + kAhead; k < std::min(first + kAhead + size, expired.size()); ++k) {
      cones_.prefetch(expired[k]);
    }
    const ConeReasons reasons = cones_.ofPairs(pairs);
    const ConeLanes excluded = reasons.largest();
    for (std::uint32_t lane = 0; lane < size; ++lane) {
      if (!(excluded[lane] > 0.0F) || !keepGroups(pairs[lane], reasons, lane, true)) {
        front_.open_.push_back(pairs[lane]);
      }
    }
    front_.next_expired_ += size;
    front_.counts_.groups += static_cast<std::uint32_t>(size);
  }

  void expand(const Pair& pair) {
    ++front_.counts_.groups;
    const auto [a, b] = pair;
    const bool opens_b = cones_.opensB(a, b);
    const std::uint32_t opened = opens_b ? cones_.b.child(b) : cones_.a.child(a);
    const ConeReasons reasons = opens_b ? cones_.withPartsOfB(a, opened) : cones_.withPartsOfA(opened, b);
    const ConeLanes excluded = reasons.largest();
    const NormalConeTree& tree = opens_b ? cones_.b : cones_.a;
    for (std::uint32_t lane = 0; lane < ConeComparison::kWidth; ++lane) {
      const Slot slot = opened + lane;
      if (tree.child(slot) == NormalConeTree::kNoChild) break;
      const Pair child{opens_b ? a : slot, opens_b ? slot : b};
      if (isFeaturePair(child) &&
          !FeaturePairs::isWanted(itemOfA(child.first).kind, itemOfB(child.second).kind)) {
        continue;
      }
      if (!(excluded[lane] > 0.0F) || !keepGroups(child, reasons, lane, opens_b)) {
        front_.open_.push_back(child);
      }
    }
  }

  void look(const Pair& pair) {
    Minimum minimum;
    if (!isMinimum(pair, minimum)) {
      settle(pair);
    } else if (limit_.makeRoom(front_.minima_)) {
      front_.minima_.push_back(minimum);
    } else {
      front_.undecided_.push_back(pair);
    }
  }

  void measure(Minimum& minimum) {
    ++front_.counts_.measured;
    minimum.seed = features_.moved(itemOfA(minimum.pair.first), itemOfB(minimum.pair.second), minimum.seed);
    seeds_.push_back(minimum.seed);
  }

  bool isMinimum(const Pair& pair, Minimum& minimum) {
    ++front_.counts_.features;
    const Item& a = itemOfA(pair.first);
    const Item& b = itemOfB(pair.second);
    const auto found = features_.findMinimum(a, b);
    if (!found) return false;
    seeds_.push_back(*found);
    resetOffers(pair);
    const bool stays = features_.offerStay(a, b, *found, offers_);
    minimum = {pair, offers_.clock(), stays ? offers_.expiry() : 0, *found};
    return true;
  }

  /// A pair of features that holds no minimum.
  void settle(const Pair& pair) {
    if (!keepFeatures(pair)) front_.undecided_.push_back(pair);
  }

  /// False for what has no slack, and without memory.
  bool keepFeatures(const Pair& pair) {
    resetOffers(pair);
    features_.offerSlacks(itemOfA(pair.first), itemOfB(pair.second), offers_);
    return !offers_.empty() && keep(pair);
  }

  /// Those that are undecided again come behind the ones that were not asked. False when the limit was
  /// reached.
  bool askUndecided() {
    std::vector<Pair>& undecided = front_.undecided_;
    const std::size_t count = undecided.size();
    std::size_t asked = 0;
    while (asked < count && !limit_.isOverNow() && limit_.makeRoom(seeds_)) {
      const Pair pair = undecided[asked++];
      look(pair);
    }
    undecided.erase(undecided.begin(), undecided.begin() + static_cast<std::ptrdiff_t>(asked));
    return asked == count;
  }

  void resetOffers(const Pair& pair) {
    offers_.reset(cones_.a.regionOf(pair.first), cones_.b.regionOf(pair.second));
  }

  /// False for what has no slack, and without memory. An offer that is hardly above 0 may be none.
  bool keepGroups(const Pair& pair, const ConeReasons& reasons, std::uint32_t lane, bool kept_is_a) {
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

  /// False without memory.
  bool keep(const Pair& pair) {
    const std::uint32_t clock = offers_.clock();
    return front_.queues_.insert(clock, std::max(offers_.expiry(), front_.motion_.now(clock) + 1), pair,
                                 limit_);
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
    kept_at_begin_ = done ? queues_.size() : 0;
  } else if (queues_.size() > kLargestGrowth * kept_at_begin_ + kSmallGrowth) {
    valid_ = false;
  }
  counts_.kept = static_cast<std::uint32_t>(queues_.size());
  counts_.live = static_cast<std::uint32_t>(minima_.size() + undecided_.size());
  counts_.undecided = static_cast<std::uint32_t>(undecided_.size());
  return done;
}

std::size_t ConeFront::memoryBytes() const {
  return queues_.memoryBytes() + minima_.capacity() * sizeof(Minimum) +
         (undecided_.capacity() + open_.capacity() + expired_.capacity()) * sizeof(Pair);
}

}  // namespace concave_distance::detail
