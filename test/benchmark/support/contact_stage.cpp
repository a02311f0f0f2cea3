#include "benchmark/support/contact_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "benchmark/support/shapes.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/body_pairs.h"

namespace concave_distance::benchmark {
namespace {

TrackerParameters distanceAlone() {
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  return parameters;
}

}  // namespace

EffectSettings effectsOf(NormalForceModel normal, FrictionModel friction) {
  EffectSettings effects;
  effects.normal_force.emplace();
  effects.normal_force->model = normal;
  effects.friction.model = friction;
  return effects;
}

void ContactStage::addFixed(const std::string& name, SurfaceMesh mesh, const Eigen::Isometry3d& pose) {
  addBody(name, std::move(mesh)).material = material;
  SimulatedBodySettings body;
  body.body = name;
  body.motion = BodyMotion::Fixed;
  body.pose = pose;
  settings.bodies.push_back(body);
}

SimulatedBodySettings& ContactStage::addFree(const std::string& name, SurfaceMesh mesh, double mass,
                                             const Eigen::Isometry3d& pose) {
  addBody(name, std::move(mesh)).material = material;
  SimulatedBodySettings& body = setFree(name, mass);
  body.pose = pose;
  return body;
}

SimulatedBodySettings& ContactStage::addFree(const std::string& name, const RoundShape& shape, double mass,
                                             const Eigen::Isometry3d& pose) {
  addRoundBody(name, shape).material = material;
  SimulatedBodySettings& body = setFree(name, mass);
  body.pose = pose;
  return body;
}

void ContactStage::letMeet(const std::string& a, const std::string& b) {
  ScenePair pair;
  pair.name = a + "/" + b;
  pair.body_a = scene.findBody(a).value();
  pair.body_b = scene.findBody(b).value();
  pair.settings.effects = effects;
  scene.pairs.push_back(pair);
}

void ContactStage::addGround(double side) {
  addFixed("ground", makeBox({side, side, 0.2}), test::at(0.0, 0.0, -0.1));
}

void ContactStage::addTower(int count, double side, double mass) {
  std::string below = "ground";
  for (int i = 0; i < count; ++i) {
    const std::string name = "box_" + std::to_string(i);
    addFree(name, makeBox({side, side, side}), mass, test::at(0.0, 0.0, (0.5 + i) * side));
    letMeet(below, name);
    below = name;
  }
}

ContactStage bedStage(FrictionModel friction) {
  ContactStage stage;
  stage.material.dissipation = 20.0;
  stage.effects = effectsOf(NormalForceModel::ElasticFoundation, friction);
  stage.effects.normal_force->foundation_stiffness = 2e6;
  return stage;
}

PairProbe::PairProbe(const SurfaceMesh& a, const SurfaceMesh& b, const EffectSettings& effects,
                     const Material& material)
    : a_(test::makeBody(a)),
      b_(test::makeBody(b)),
      tracker_("probe", a_, b_, distanceAlone()),
      effects_(a_, b_, effects, inContact(material, material)) {}

const PairContacts& PairProbe::at(const Eigen::Isometry3d& a_from_b, const RelativeTwist& b_in_a) {
  tracker_.update(a_from_b, time_, solution_);
  effects_.update(solution_, b_in_a, 0.0, contacts_);
  time_ += 1e-3;
  return contacts_;
}

SurfaceMesh makePolygonPrism(double radius, double length, int corners) {
  test::Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * i / corners;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return test::makeExtrusion(outline, length);
}

SurfaceMesh makeHollowCube(double outer_side, double inner_side) {
  const SurfaceMesh outer = makeBox({outer_side, outer_side, outer_side});
  return test::makeJoined(outer, test::makeTurned(makeBox({inner_side, inner_side, inner_side})));
}

SurfaceMesh makeInnerCorner() {
  const SurfaceMesh profile =
      test::makeExtrusion({{-0.1, -0.1}, {0.5, -0.1}, {0.5, 0.0}, {0.0, 0.0}, {0.0, 0.4}, {-0.1, 0.4}}, 0.6);
  return moved(profile, Eigen::Isometry3d(Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX())));
}

double depthOfLowestVertex(const SurfaceMesh& mesh, const Eigen::Matrix3d& turn) {
  double lowest = 0.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices()) lowest = std::min(lowest, turn.row(2).dot(vertex));
  return -lowest;
}

}  // namespace concave_distance::benchmark
