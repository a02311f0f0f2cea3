#include "listed_places.h"

#include <string_view>
#include <unordered_map>

#include "concave_distance/base/error.h"
#include "near_pairs.h"

namespace concave_distance {
namespace {

void requireBodies(const Scene& scene, const ScenePair& pair) {
  const auto where = [&] { return "scene, pair '" + pair.name + "'"; };
  const std::size_t count = scene.bodies.size();
  for (const std::size_t body : {pair.body_a, pair.body_b}) {
    if (body >= count) {
      throw Error(where(), "it names body " + std::to_string(body) + " of " + std::to_string(count),
                  "bodies are numbered from 0 in the order of scene.bodies");
    }
    if (!scene.bodies[body].mesh) {
      throw Error(where(), "body '" + scene.bodies[body].name + "' has no mesh", "set SceneBody::mesh");
    }
  }
  if (pair.body_a == pair.body_b) {
    throw Error(where(), "both its bodies are '" + scene.bodies[pair.body_a].name + "'", "name two bodies");
  }
}

bool isOfTheSameBodies(const TrackedPair& tracked, const Scene& scene, const ScenePair& wanted) {
  return isSameBody(*tracked.body_a, scene.bodies[wanted.body_a]) &&
         isSameBody(*tracked.body_b, scene.bodies[wanted.body_b]);
}

}  // namespace

bool isUntouched(const TrackedPair& tracked, const Scene& scene, std::size_t index) {
  const ScenePair& wanted = scene.pairs[index];
  return tracked.origin.get() == &wanted && tracked.body_a.get() == &scene.bodies[wanted.body_a] &&
         tracked.body_b.get() == &scene.bodies[wanted.body_b];
}

std::vector<std::optional<std::size_t>> placesInTracker(const SceneTracker::Pairs& pairs, std::size_t listed,
                                                        const Scene& scene) {
  std::vector<std::optional<std::size_t>> places(scene.pairs.size());
  // Usually an edit leaves most pairs as they are, in their places.
  std::unordered_map<std::string_view, std::size_t> moved;
  for (const ScenePair& pair : scene.pairs) requireBodies(scene, pair);
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    if (index < places.size() && index < listed && isUntouched(*pairs[index], scene, index)) {
      places[index] = index;
    } else {
      moved.emplace(pairs[index]->origin->name, index);
    }
  }
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index]) continue;
    const ScenePair& wanted = scene.pairs[index];
    const auto found = moved.find(wanted.name);
    if (found != moved.end() && isOfTheSameBodies(*pairs[found->second], scene, wanted)) {
      places[index] = found->second;
    }
  }
  return places;
}

}  // namespace concave_distance
