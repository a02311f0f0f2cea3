#include "concave_distance/ros/tracked_pair.h"

namespace concave_distance {

TrackedPair::TrackedPair(const Scene& scene, const ScenePair& pair, const std::string& reference_frame,
                         std::uint64_t first_id)
    : mesh_a(scene.bodies[pair.body_a].mesh),
      mesh_b(scene.bodies[pair.body_b].mesh),
      bounds_a(scene.bodies[pair.body_a].bounds),
      bounds_b(scene.bodies[pair.body_b].bounds),
      frames{reference_frame, scene.bodies[pair.body_a].frame, scene.bodies[pair.body_b].frame},
      settings(pair.settings),
      enabled(pair.enabled),
      effects(mesh_a, mesh_b,
              inContact(scene.bodies[pair.body_a].material, scene.bodies[pair.body_b].material)),
      largest_id(first_id) {
  heading.pair = pair.name;
  heading.body_a = scene.bodies[pair.body_a].name;
  heading.body_b = scene.bodies[pair.body_b].name;
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

void TrackedPair::prepare() {
  if (effects.prepare(settings.effects, demand.effects)) {
    must_solve = true;
  }
  if (tracker && !stale_parameters && tracker->parameters().niches_wanted == demand.niches) {
    return;
  }
  TrackerParameters parameters = settings.tracker;
  parameters.niches_wanted = demand.niches;
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
