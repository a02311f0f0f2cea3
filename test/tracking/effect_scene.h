#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"

namespace concave_distance::test {

inline std::shared_ptr<const BodyMesh> body(const std::string& name, SurfaceMesh mesh) {
  return std::make_shared<const BodyMesh>(name, std::move(mesh), BodyMeshOptions());
}

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

inline EffectSettings spring(double stiffness, FrictionModel friction = FrictionModel::None) {
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::SpringDashpot;
  settings.normal_force->distribution = ForceDistribution::Lumped;
  settings.normal_force->stiffness = stiffness;
  settings.friction.model = friction;
  return settings;
}

/// A pair that is tracked and whose effects are run.
struct EffectScene {
  EffectScene(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
              const EffectSettings& settings)
      : tracker("pair", a, b, TrackerParameters()),
        effects(a, b, settings, inContact(Material(), Material())) {}
  void update(const Eigen::Isometry3d& pose, double step = 0.01, const RelativeTwist& twist = {}) {
    time += step;
    tracker.update(pose, time, solution);
    effects.update(solution, twist, step, contacts);
  }

  PairTracker tracker;
  PairEffects effects;
  PairSolution solution;
  PairContacts contacts;
  double time = 0.0;
};

/// A table on two feet.
inline SurfaceMesh twoFeet() {
  const SurfaceMesh foot = makeBox({0.1, 0.1, 0.2});
  return makeJoined(movedSurface(foot, at(-0.4, 0.0, 0.0)), foot, {0.4, 0.0, 0.0});
}

}  // namespace concave_distance::test
