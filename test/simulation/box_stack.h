#pragma once

#include <string>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"

namespace concave_distance::test {

inline constexpr double kStackFoundation = 2e9;  ///< Pa/m
inline constexpr double kStackArea = 0.2 * 0.2;  ///< of a face, m^2
inline constexpr double kStackHeight = 0.1;      ///< of a box, m

/// Boxes of these masses on each other, flush, on a floor at z = 0, with friction by bristles. Every setting
/// of the simulation is the default.
inline SceneBuilder stackOf(const std::vector<double>& masses) {
  SceneBuilder builder;
  Material material;
  material.dissipation = 20.0;
  builder.addBody("floor", makeBox({2.0, 2.0, 0.1})).material = material;
  builder.setFixed("floor", at(0.0, 0.0, -0.05));
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const std::string name = "box" + std::to_string(i);
    builder.addBody(name, makeBox({0.2, 0.2, kStackHeight})).material = material;
    builder.setFree(name, masses[i]).pose = at(0.0, 0.0, kStackHeight * (static_cast<double>(i) + 0.5));
    ScenePair pair;
    pair.name = name;
    pair.body_a = i;
    pair.body_b = i + 1;
    pair.settings.effects.normal_force.emplace();
    pair.settings.effects.normal_force->model = NormalForceModel::ElasticFoundation;
    pair.settings.effects.normal_force->foundation_stiffness = kStackFoundation;
    pair.settings.effects.friction.model = FrictionModel::Bristle;
    builder.scene.pairs.push_back(pair);
  }
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  return builder;
}

}  // namespace concave_distance::test
