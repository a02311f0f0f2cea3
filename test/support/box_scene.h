#pragma once

#include <memory>
#include <string>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// A box of side 1 around the origin of its frame, which is called as the body.
inline SceneBody unitBox(const std::string& name) {
  SceneBody body;
  body.name = name;
  body.frame = name;
  BodyMeshOptions options;
  options.max_edge_length = 0.5;
  body.mesh = std::make_shared<const BodyMesh>(name, makeBox(Eigen::Vector3d::Ones()), options);
  body.bounds = boundsOf(body.mesh->surface());
  return body;
}

/// Boxes a, b, c and the pairs a/b and a/c.
inline Scene threeBoxes() {
  Scene scene;
  for (const char* name : {"a", "b", "c"}) {
    scene.bodies.push_back(unitBox(name));
  }
  for (std::size_t other = 1; other <= 2; ++other) {
    ScenePair pair;
    pair.name = "a/" + scene.bodies[other].name;
    pair.body_a = 0;
    pair.body_b = other;
    pair.settings.tracker.cold.population_size = 40;
    scene.pairs.push_back(pair);
  }
  return scene;
}

}  // namespace concave_distance
