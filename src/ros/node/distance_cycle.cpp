#include "distance_cycle.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>
#include <utility>

#include "ros/tf/cloud_age.h"

namespace concave_distance {

DistanceCycle::DistanceCycle(const TransformBuffer& transforms, CycleOptions options)
    : transforms_(transforms),
      options_(std::move(options)),
      tracker_({options_.threads, options_.stop, options_.prepares_in_background}),
      locate_(options_.reference_frame) {}

void DistanceCycle::setScene(const Scene& scene, bool settings_changed) {
  const std::vector<std::optional<std::size_t>> places = tracker_.placesNow(scene);
  PublishedPairs next(places.size());
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index] && *places[index] < pairs_.size()) continue;
    next[index] = std::make_unique<PublishedPair>(scene, scene.pairs[index], options_.reference_frame);
  }
  std::vector<std::string> body_frames;
  std::vector<Eigen::Isometry3d> body_places;
  std::vector<Cloud> clouds;
  for (const SceneBody& body : scene.bodies) {
    body_frames.push_back(body.frame);
    body_places.push_back(body.frame_from_body);
    if (body.cloud) clouds.push_back({body_places.size() - 1, body.name, body.cloud});
  }
  retired_.reserve(retired_.size() + pairs_.size());
  spare_.reserve(spare_.size() + pairs_.size());
  tracker_.setScene(scene, settings_changed);

  // Nothing below allocates: from here on it is the new scene that is followed.
  locate_.setBodies(std::move(body_frames), std::move(body_places));
  clouds_ = std::move(clouds);
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (!next[index]) next[index] = std::move(pairs_[*places[index]]);
    next[index]->tracked = tracker_.pairs()[index];
  }
  const SceneTracker::Pairs retired = tracker_.takeRetired();
  for (auto& pair : pairs_) {
    if (!pair) continue;
    const auto is_it = [&](const auto& tracked) { return tracked == pair->tracked; };
    const bool has_alert = std::any_of(retired.begin(), retired.end(), is_it);
    (has_alert ? retired_ : spare_).push_back(std::move(pair));
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
  return run([&](std::size_t place,
                 const TrackedPair&) { return place < demand.size() ? demand[place] : PairDemand(); },
             now, end);
}

CycleCounts DistanceCycle::run(const SceneTracker::DemandOf& demand_of, ros::Time now,
                               WorkLimit::Clock::time_point end) {
  for (const auto& pair : pairs_) pair->was_watched = pair->demand().watched;
  locate_.update(transforms_.current(), now, options_.stale_after);
  hideUnusableClouds(now);
  const CycleCounts counts =
      tracker_.update(locate_.poses(), locate_.seconds(now), demand_of, std::ref(locate_), end);
  followPairs();
  for (const auto& pair : pairs_) describe(*pair);
  return counts;
}

void DistanceCycle::hideUnusableClouds(ros::Time now) {
  for (const Cloud& cloud : clouds_) {
    if (auto why = whyUnusable(cloud.name, *cloud.state, now)) locate_.hide(cloud.body, std::move(*why));
  }
}

// Moves the publishers of each pair to the place that the pair has now.
void DistanceCycle::followPairs() {
  const SceneTracker::Pairs& tracked = tracker_.pairs();
  const auto is_there = [&](std::size_t i) {
    return i < pairs_.size() && pairs_[i] && pairs_[i]->tracked == tracked[i];
  };
  std::size_t first = 0;
  while (first < tracked.size() && is_there(first)) ++first;
  if (first == tracked.size() && pairs_.size() == first) {
    spare_.clear();
    return;
  }
  PublishedPairs next(tracked.size());
  std::unordered_map<const TrackedPair*, std::unique_ptr<PublishedPair>*> known;
  for (PublishedPairs* list : {&pairs_, &spare_}) {
    for (auto& pair : *list) {
      if (pair) known.emplace(pair->tracked.get(), &pair);
    }
  }
  for (std::size_t i = first; i < tracked.size(); ++i) {
    if (known.count(tracked[i].get()) != 0) continue;
    next[i] = std::make_unique<PublishedPair>(tracked[i], options_.reference_frame);
  }
  // Nothing below allocates.
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    if (!next[i]) next[i] = std::move(*known.find(tracked[i].get())->second);
  }
  pairs_ = std::move(next);
  spare_.clear();
}

// Fills what the messages say about the cycle.
void DistanceCycle::describe(PublishedPair& pair) {
  const TrackedPair& tracked = *pair.tracked;
  pair.heading.accuracy = tracked.settings.tracker.accuracy;
  pair.heading.with_niches = tracked.demand.niches;
  pair.heading.warning = tracked.warning.state() == WarningState::Warning;
  if (pair.was_watched && !tracked.demand.watched) {
    pair.status.code = PairStatus::DISABLED;
    pair.status.message = tracked.origin->enabled ? "nobody subscribes" : "the pair was switched off";
  }
  if (!tracked.demand.due) return;
  const std::size_t body_a = tracked.origin->body_a;
  const std::size_t body_b = tracked.origin->body_b;
  const FrameTransform place = locate_.placeOfA(body_a, body_b, tracked.input.located);
  pair.heading.stamp = place.stamp;
  pair.status = toStatus(place.status, place.message);
  if (place.status != TransformStatus::Ok) return;
  pair.heading.reference_from_a = place.target_from_source;
  if (tracked.state == PairState::BeyondCutoff) pair.status.code = PairStatus::BEYOND_CUTOFF;
  if (tracked.state == PairState::Stopped) {
    pair.status.code = PairStatus::DISABLED;
    pair.status.message = "the node is shutting down";
  }
}

}  // namespace concave_distance
