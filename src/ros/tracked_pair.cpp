#include "concave_distance/ros/tracked_pair.h"

namespace concave_distance {

namespace {

const SceneBody& bodyA(const Scene& scene, std::size_t pair) {
  return scene.bodies[scene.pairs[pair].body_a];
}

const SceneBody& bodyB(const Scene& scene, std::size_t pair) {
  return scene.bodies[scene.pairs[pair].body_b];
}

}  // namespace

TrackedPair::TrackedPair(const Scene& scene, std::size_t index, const std::string& reference_frame,
                         std::uint64_t first_id)
    : origin(scene.pairs.share(index)),
      mesh_a(bodyA(scene, index).mesh),
      mesh_b(bodyB(scene, index).mesh),
      bounds_a(bodyA(scene, index).bounds),
      bounds_b(bodyB(scene, index).bounds),
      frames{reference_frame, bodyA(scene, index).frame, bodyB(scene, index).frame},
      settings(origin->settings),
      enabled(origin->enabled),
      effects(mesh_a, mesh_b, inContact(bodyA(scene, index).material, bodyB(scene, index).material)),
      largest_id(first_id) {
  heading.pair = origin->name;
  heading.body_a = bodyA(scene, index).name;
  heading.body_b = bodyB(scene, index).name;
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
    tracker = std::make_unique<PairTracker>(heading.pair, mesh_a, mesh_b, parameters);
  }
  heading.accuracy = parameters.accuracy;
  stale_parameters = false;
  must_solve = true;
}

}  // namespace concave_distance
