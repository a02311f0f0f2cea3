#include "published_pair.h"

#include <utility>

namespace concave_distance {

PublishedPair::PublishedPair(const Scene& scene, const ScenePair& pair, const std::string& reference_frame) {
  heading.pair = pair.name;
  heading.body_a = scene.bodies[pair.body_a].name;
  heading.body_b = scene.bodies[pair.body_b].name;
  heading.reference_frame = reference_frame;
  heading.accuracy = pair.settings.tracker.accuracy;
}

PublishedPair::PublishedPair(std::shared_ptr<const TrackedPair> tracked_pair,
                             const std::string& reference_frame)
    : tracked(std::move(tracked_pair)) {
  heading.pair = tracked->origin->name;
  heading.body_a = tracked->body_a->name;
  heading.body_b = tracked->body_b->name;
  heading.reference_frame = reference_frame;
  heading.accuracy = tracked->settings.tracker.accuracy;
}

PairNiches toNiches(const PublishedPair& pair) {
  if (pair.tracked->solved()) return toNiches(pair.heading, pair.tracked->solution);
  PairNiches message = emptyNiches(pair.heading, pair.status);
  if (pair.tracked->box_bound) {
    message.nearest.has_lower_bound = 1;
    message.nearest.lower_bound = *pair.tracked->box_bound;
  }
  return message;
}

}  // namespace concave_distance
