#include "published_pair.h"

namespace concave_distance {

PublishedPair::PublishedPair(const Scene& scene, const ScenePair& pair, const std::string& reference_frame)
    : frames{reference_frame, scene.bodies[pair.body_a].frame, scene.bodies[pair.body_b].frame} {
  heading.pair = pair.name;
  heading.body_a = scene.bodies[pair.body_a].name;
  heading.body_b = scene.bodies[pair.body_b].name;
  heading.reference_frame = reference_frame;
  heading.accuracy = pair.settings.tracker.accuracy;
}

}  // namespace concave_distance
