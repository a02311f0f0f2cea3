#pragma once

#include <memory>
#include <string>
#include <utility>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance::test {

/// A scene of two bodies and their pair, made without files. The grid is coarse.
struct SceneBuilder {
  Scene scene;
  SimulationSettings settings;

  SceneBody& addBody(const std::string& name, SurfaceMesh mesh) {
    BodyMeshOptions options;
    options.max_edge_length = 100.0;
    SceneBody body;
    body.name = body.frame = name;
    body.bounds = boundsOf(mesh);
    body.mesh = std::make_shared<const BodyMesh>(name, std::move(mesh), options);
    scene.bodies.push_back(std::move(body));
    return scene.bodies.edit(scene.bodies.size() - 1);
  }

  /// An exact round solid.
  SceneBody& addRoundBody(const std::string& name, const RoundShape& shape) {
    BodyMeshOptions options;
    options.max_edge_length = 100.0;
    options.shape = shape;
    SceneBody body;
    body.name = body.frame = name;
    body.mesh = std::make_shared<const BodyMesh>(name, inscribedMesh(shape, name), options);
    body.bounds = boundsOf(*body.mesh);
    scene.bodies.push_back(std::move(body));
    return scene.bodies.edit(scene.bodies.size() - 1);
  }

  /// Gives the body free motion; the settings are valid until the next call.
  SimulatedBodySettings& setFree(const std::string& name, double mass) {
    SimulatedBodySettings body;
    body.body = name;
    body.mass = mass;
    settings.bodies.push_back(body);
    return settings.bodies.back();
  }

  void setFixed(const std::string& name, const Eigen::Isometry3d& pose) {
    SimulatedBodySettings body;
    body.body = name;
    body.motion = BodyMotion::Fixed;
    body.pose = pose;
    settings.bodies.push_back(body);
  }

  /// Between the first two bodies.
  PairSettings& addPair() {
    ScenePair pair;
    pair.name = scene.bodies[0].name + "/" + scene.bodies[1].name;
    pair.body_a = 0;
    pair.body_b = 1;
    scene.pairs.push_back(pair);
    return scene.pairs.edit(scene.pairs.size() - 1).settings;
  }

  /// The same, with one force for a whole region; valid until the next call.
  NormalForceSettings& addLumpedPair(NormalForceModel model) {
    NormalForceSettings& normal = addPair().effects.normal_force.emplace();
    normal.model = model;
    normal.distribution = ForceDistribution::Lumped;
    return normal;
  }

  Simulation simulation() const { return Simulation(scene, settings); }
};

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace concave_distance::test
