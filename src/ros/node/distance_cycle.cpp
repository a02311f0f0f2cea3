#include "distance_cycle.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "ros/time_difference.h"

namespace concave_distance {

DistanceCycle::DistanceCycle(const TransformBuffer& transforms, CycleOptions options)
    : transforms_(transforms),
      options_(std::move(options)),
      tracker_({options_.threads, options_.stop, options_.prepares_in_background}) {}

void DistanceCycle::setScene(const Scene& scene, bool settings_changed) {
  const std::vector<std::optional<std::size_t>> places = tracker_.placesNow(scene);
  PublishedPairs next(places.size());
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index]) continue;
    next[index] = std::make_unique<PublishedPair>(scene, scene.pairs[index], options_.reference_frame);
  }
  retired_.reserve(retired_.size() + pairs_.size());
  tracker_.setScene(scene, settings_changed);

  // Nothing below allocates: from here on it is the new scene that is followed.
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index]) next[index] = std::move(pairs_[*places[index]]);
    next[index]->tracked = tracker_.pairs()[index];
  }
  const SceneTracker::Pairs retired = tracker_.takeRetired();
  for (auto& pair : pairs_) {
    const auto is_it = [&](const auto& tracked) { return pair && tracked == pair->tracked; };
    if (std::any_of(retired.begin(), retired.end(), is_it)) retired_.push_back(std::move(pair));
  }
  pairs_ = std::move(next);
}

PublishedPairs DistanceCycle::takeRetired() {
  for (const auto& pair : retired_) {
    pair->heading.warning = false;
    pair->status.code = PairStatus::DISABLED;
    pair->status.message = "the pair was removed with one of its bodies";
  }
  return std::exchange(retired_, {});
}

CycleCounts DistanceCycle::run(const std::vector<PairDemand>& demand, ros::Time now,
                               WorkLimit::Clock::time_point end) {
  was_watched_.clear();
  for (const auto& pair : pairs_) was_watched_.push_back(pair->demand().watched);
  const std::shared_ptr<const tf2::BufferCore> buffer = transforms_.current();
  const auto locate_pair = [&](std::size_t index) { return locate(*pairs_[index], *buffer, now); };
  const CycleCounts counts = tracker_.update(demand, std::cref(locate_pair), end);
  for (std::size_t index = 0; index < pairs_.size(); ++index) describe(*pairs_[index], was_watched_[index]);
  return counts;
}

// Fills stamp, poses and the status of the transforms.
PairInput DistanceCycle::locate(PublishedPair& pair, const tf2::BufferCore& buffer, ros::Time now) const {
  const PairTransforms transforms =
      lookUpPair(buffer, pair.frames, now, options_.stale_after, pair.ancestors);
  pair.heading.stamp = transforms.status == TransformStatus::Missing ? now : transforms.stamp;
  pair.status = toStatus(transforms.status, transforms.message);
  PairInput input;
  input.located = transforms.status == TransformStatus::Ok;
  if (!input.located) return input;
  pair.heading.reference_from_a = transforms.reference_from_a;
  input.a_from_b = transforms.a_from_b;
  input.fixed = transforms.fixed;
  input.time = transforms.stamp.toSec();
  // Stamps differ by less than a double of seconds since 1970 resolves.
  input.step = secondsBetween(pair.solved_stamp, transforms.stamp);
  return input;
}

// Fills what the messages say about the cycle.
void DistanceCycle::describe(PublishedPair& pair, bool was_watched) {
  const TrackedPair& tracked = *pair.tracked;
  pair.heading.accuracy = tracked.settings.tracker.accuracy;
  pair.heading.with_niches = tracked.demand.niches;
  pair.heading.warning = tracked.warning.state() == WarningState::Warning;
  if (was_watched && !tracked.demand.watched) {
    pair.status.code = PairStatus::DISABLED;
    pair.status.message = tracked.origin->enabled ? "nobody subscribes" : "the pair was switched off";
  }
  if (!tracked.demand.due) return;
  if (tracked.state == PairState::BeyondCutoff) pair.status.code = PairStatus::BEYOND_CUTOFF;
  if (tracked.state == PairState::Stopped) {
    pair.status.code = PairStatus::DISABLED;
    pair.status.message = "the node is shutting down";
  }
  if (tracked.solved() && !tracked.repeated) pair.solved_stamp = pair.heading.stamp;
}

}  // namespace concave_distance
