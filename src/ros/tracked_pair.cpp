#include "concave_distance/ros/tracked_pair.h"

namespace concave_distance {

TrackedPair::TrackedPair(const Scene& scene, std::size_t index, const std::string& reference_frame,
                         std::uint64_t first_id)
    : origin(scene.pairs.share(index)),
      body_a(scene.bodies.share(origin->body_a)),
      body_b(scene.bodies.share(origin->body_b)),
      frames{reference_frame, body_a->frame, body_b->frame},
      settings(origin->settings),
      enabled(origin->enabled),
      effects(body_a->mesh, body_b->mesh, inContact(body_a->material, body_b->material)),
      largest_id(first_id) {
  heading.pair = origin->name;
  heading.body_a = body_a->name;
  heading.body_b = body_b->name;
  heading.reference_frame = reference_frame;
  heading.accuracy = settings.tracker.accuracy;
  heading.id_offset = first_id;
}

void TrackedPair::restart() {
  if (tracker) {
    tracker->reset();
  }
  effects.reset();
  solved = false;
  must_solve = true;
}

void TrackedPair::discard() {
  tracker.reset();
  effects.prepare(settings.effects, false);
  heading.id_offset = largest_id;
  solved = false;
  must_solve = true;
}

void TrackedPair::prepare(const std::atomic<bool>* stop) {
  if (effects.prepare(settings.effects, demand.effects)) {
    must_solve = true;
  }
  if (tracker && !stale_parameters && tracker->parameters().niches_wanted == demand.niches) {
    return;
  }
  TrackerParameters parameters = settings.tracker;
  parameters.niches_wanted = demand.niches;
  parameters.stop = stop;
  if (tracker) {
    tracker->setParameters(parameters);
  } else {
    tracker = std::make_unique<PairTracker>(heading.pair, body_a->mesh, body_b->mesh, parameters);
  }
  heading.accuracy = parameters.accuracy;
  stale_parameters = false;
  must_solve = true;
}

}  // namespace concave_distance
