#include "bag_replay.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace concave_distance {
namespace {

constexpr char kNotLookedUp = 2;

CycleOptions withAllTimes(CycleOptions options) {
  options.most_times = std::numeric_limits<std::size_t>::max();
  return options;
}

// Answers would depend on the machine.
Scene withoutBudgets(Scene scene) {
  const auto change = [](PairSettings& settings) {
    settings.tracker.time_budget = std::numeric_limits<double>::infinity();
  };
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) change(scene.pairs.edit(i).settings);
  for (PairSettings& settings : scene.rules.settings) change(settings);
  change(scene.defaults.pairs);
  return scene;
}

bool isMissing(const FramePlace& place) {
  return place.status == TransformStatus::Missing;
}

bool isFixed(const FramePlace& place) {
  return place.status == TransformStatus::Ok && place.stamp.isZero();
}

}  // namespace

BagReplay::BagReplay(Scene scene, ReplayOptions options, Sink sink)
    : options_(std::move(options)),
      sink_(std::move(sink)),
      moments_(options_.limits, options_.cycle.stale_after),
      rows_(options_.patterns),
      cycle_(moments_.buffer(), withAllTimes(options_.cycle)),
      depends_(scene.bodies.size(), kNotLookedUp) {
  cycle_.setScene(withoutBudgets(std::move(scene)));
}

void BagReplay::take(const BagMessage& message) {
  moments_.take(message);
  answerWhatIsReady(false);
}

void BagReplay::finish() {
  answerWhatIsReady(true);
}

void BagReplay::answerWhatIsReady(bool is_end) {
  while (!isStopped()) {
    const std::optional<BagMoment> moment = moments_.next(is_end);
    if (!moment) return;
    answer(*moment);
  }
}

void BagReplay::answer(const BagMoment& moment) {
  ++counts_.stamps;
  std::fill(depends_.begin(), depends_.end(), kNotLookedUp);
  cycle_.run([&](std::size_t, const TrackedPair& pair) { return demandOf(pair, moment); }, moment.stamp);
  if (isStopped()) return;
  was_beyond_ = was_beyond_ || (options_.patterns.empty() && cycle_.others().beyond > 0);
  for (const auto& pair : cycle_.pairs()) {
    if (!pair->demand().due) continue;
    const PairNiches message = toNiches(*pair);
    if (!rows_.take(*pair, message)) continue;
    ++counts_.rows;
    counts_.answers += message.nearest.has_distance;
    sink_({moment.recorded, message});
  }
}

PairDemand BagReplay::demandOf(const TrackedPair& pair, const BagMoment& moment) {
  if (!rows_.isWanted(pair.origin->name)) return {};
  const auto moves = [&](std::size_t body) {
    if (depends_[body] == kNotLookedUp) {
      depends_[body] = static_cast<char>(cycle_.frames().dependsOn(body, moment.frames));
    }
    return depends_[body] != 0;
  };
  const std::size_t a = pair.origin->body_a;
  const std::size_t b = pair.origin->body_b;
  const FramePlace& place_a = cycle_.frames().place(a);
  const FramePlace& place_b = cycle_.frames().place(b);
  PairDemand demand{true, false, options_.niches, false};
  demand.due = isMissing(place_a) || isMissing(place_b) || (isFixed(place_a) && isFixed(place_b)) ||
               moves(a) || moves(b);
  return demand;
}

}  // namespace concave_distance
