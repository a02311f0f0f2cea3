#include "minima_tracker.h"

#include "base/run_in_order.h"
#include "cone_sweep.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kUsualMinima = 64;
constexpr std::size_t kUsualExpired = 1024;
/// Steps of the one sweep after which few open pairs are known to hold much.
constexpr std::size_t kManySteps = 2048;

/// Behind what is there, whatever the limit says: no pair may be lost, and slices are small.
template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

/// One call of collect().
class MinimaTracker::Stage {
 public:
  Stage(MinimaTracker& front, const PairFrame& frame, ConeChoice choice, double cutoff, WorkLimit& limit,
        std::size_t most_comparisons)
      : front_(front),
        frame_(frame),
        choice_(choice),
        cutoff_(cutoff),
        limit_(limit),
        most_comparisons_(most_comparisons),
        sweep_(frame, choice, cutoff, front.motion_, front.lists_, limit) {
    sweep_.keepIn(front.queues_, limit);
  }

  bool isEmpty() const { return sweep_.conesOfA().empty() || sweep_.conesOfB().empty(); }

  void begin() {
    SweepLists& lists = front_.lists_;
    front_.counts_.began_anew = true;
    front_.motion_.begin(sweep_.conesOfA(), sweep_.conesOfB(), frame_, frame_.size);
    front_.queues_.begin(front_.motion_.size());
    lists.minima.clear();
    lists.undecided.clear();
    // Most pairs never outgrow these sizes.
    lists.minima.reserve(kUsualMinima);
    lists.undecided.reserve(kUsualMinima);
    lists.open.reserve(kUsualMinima);
    front_.expired_.reserve(kUsualExpired);
    front_.expired_.clear();
    front_.next_expired_ = 0;
    lists.open.assign(1, {NormalConeTree::kRoot, NormalConeTree::kRoot});
    front_.valid_ = true;
  }

  /// Appends what has expired to what earlier cycles have left.
  void expire() {
    std::vector<SlotPair>& expired = front_.expired_;
    expired.erase(expired.begin(), expired.begin() + static_cast<std::ptrdiff_t>(front_.next_expired_));
    front_.next_expired_ = 0;
    const std::size_t before = front_.queues_.size();
    const auto take = [&](const SlotPair& pair) { expired.push_back(pair); };
    for (std::uint32_t moved_distance = 0; moved_distance < front_.motion_.size(); ++moved_distance) {
      front_.queues_.advance(moved_distance, front_.motion_.now(moved_distance), take);
    }
    front_.counts_.expired = static_cast<std::uint32_t>(before - front_.queues_.size());
  }

  bool askLive() { return sweep_.askLive(); }

  /// Compares what has expired and opens what is excluded no more. False when the limit was reached.
  bool run() {
    const SweepLists& lists = front_.lists_;
    const std::vector<SlotPair>& open = lists.open;
    while (!open.empty() || expiredCount() > 0) {
      if (std::size_t{lists.groups} + lists.features > most_comparisons_) return false;
      const bool much_expired = expiredCount() >= front_.sliced_from_;
      const bool is_much = much_expired || open.size() >= ConeSlices::kManyOpen;
      if (is_much && !limit_.hasRefusedPairs()) {  // then the one sweep goes on
        if (limit_.isOver()) return false;
        much_expired ? runExpiredSlices() : runOpenSlices();
      } else if (!runAlone()) {
        return false;
      }
    }
    return true;
  }

 private:
  std::size_t expiredCount() const { return front_.expired_.size() - front_.next_expired_; }

  /// The one sweep; few open pairs that hold much are opened until there are enough for slices.
  bool runAlone() {
    const SlotPair* const pairs = front_.expired_.data();
    ExpiredPairs expired{pairs + front_.next_expired_, pairs + front_.expired_.size()};
    std::size_t steps = kManySteps;
    const bool done = sweep_.run(expired, steps);
    front_.next_expired_ = static_cast<std::size_t>(expired.next - pairs);
    return done || (steps == 0 && sweep_.widen(ConeSlices::kManyOpen));
  }

  void runExpiredSlices() {
    ConeSlices& slices = front_.slices_;
    slices.prepare();
    const std::size_t taken =
        slices.takeExpired(front_.expired_.data() + front_.next_expired_, expiredCount());
    runSlices();
    // The pairs that a full slice has left come before those that none has taken.
    SlotPair* left = front_.expired_.data() + front_.next_expired_ + taken;
    for (std::size_t i = slices.used(); i-- > 0;) {
      left = std::move_backward(slices[i].expired.next, slices[i].expired.end, left);
    }
    front_.next_expired_ = static_cast<std::size_t>(left - front_.expired_.data());
  }

  void runOpenSlices() {
    front_.slices_.prepare();
    front_.slices_.takeOpen(front_.lists_.open);
    runSlices();
  }

  void runSlices() {
    ConeSlices& slices = front_.slices_;
    front_.counts_.slices += static_cast<std::uint32_t>(slices.used());
    const std::size_t threads = ThreadTeam::countHere();
    const WorkLimit limit = limit_;
    const auto look = [&](std::size_t i) {
      WorkLimit own = limit;
      ConeSweep sweep(frame_, choice_, cutoff_, front_.motion_, slices[i].lists, own, ConeSlices::kMostKept);
      // One thread inserts in the same order without a buffer.
      if (threads == 1) sweep.keepIn(front_.queues_, limit_);
      std::size_t steps = std::numeric_limits<std::size_t>::max();
      sweep.run(slices[i].expired, steps);
    };
    runInOrder<ConeSlices::kCount>(slices.used(), threads, look,
                                   [&](std::size_t i) { add(slices[i].lists); });
  }

  void add(const SweepLists& found) {
    SweepLists& lists = front_.lists_;
    for (const KeptPair& kept : found.kept) {
      if (!front_.queues_.insert(kept.moved_distance, kept.expiry, kept.pair, limit_))
        lists.open.push_back(kept.pair);
    }
    append(lists.open, found.open);
    append(lists.minima, found.minima);
    append(lists.undecided, found.undecided);
    append(lists.candidates, found.candidates);
    lists.groups += found.groups;
    lists.features += found.features;
    lists.measured += found.measured;
  }

  MinimaTracker& front_;
  const PairFrame& frame_;
  ConeChoice choice_;
  double cutoff_;
  WorkLimit& limit_;
  std::size_t most_comparisons_;
  ConeSweep sweep_;
};

bool MinimaTracker::collect(const PairFrame& frame, ConeChoice choice, double cutoff,
                            std::vector<MinimumCandidate>& candidates, WorkLimit& limit,
                            std::size_t most_comparisons) {
  counts_ = {};
  Stage stage(*this, frame, choice, cutoff, limit, most_comparisons);
  if (stage.isEmpty()) return true;
  lists_.groups = lists_.features = lists_.measured = 0;
  lists_.candidates.swap(candidates);
  valid_ = valid_ && cutoff == cutoff_ && choice == choice_ && motion_.advance(frame);
  cutoff_ = cutoff;
  choice_ = choice;
  bool done = true;
  if (!valid_) {
    stage.begin();
    done = stage.run();
    kept_at_begin_ = 0;
  } else {
    done = stage.askLive();
    stage.expire();
    done = stage.run() && done;
  }
  lists_.candidates.swap(candidates);
  // A sweep that a limit has ended grows until it is whole.
  if (kept_at_begin_ == 0) {
    kept_at_begin_ = done ? queues_.size() : 0;
  } else if (hasGrown(kLargestGrowth)) {
    valid_ = false;
  }
  count();
  return done;
}

void MinimaTracker::count() {
  counts_.groups = lists_.groups;
  counts_.features = lists_.features;
  counts_.measured = lists_.measured;
  counts_.kept = static_cast<std::uint32_t>(queues_.size());
  counts_.live = static_cast<std::uint32_t>(lists_.minima.size() + lists_.undecided.size());
  counts_.undecided = static_cast<std::uint32_t>(lists_.undecided.size());
}

}  // namespace concave_distance::detail
