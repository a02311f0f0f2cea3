#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"

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
  SurfaceMesh left = makeBox({0.1, 0.1, 0.2});
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (const double x : {-0.4, 0.4}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Eigen::Vector3d& v : left.vertices()) vertices.push_back(v + Eigen::Vector3d(x, 0, 0));
    for (const TriangleNodes& t : left.triangles()) {
      triangles.push_back(
          {NodeIndex{t[0].value + first}, NodeIndex{t[1].value + first}, NodeIndex{t[2].value + first}});
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "two feet");
}

}  // namespace concave_distance::test
