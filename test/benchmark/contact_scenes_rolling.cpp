#include <algorithm>
#include <cmath>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

constexpr double kRadius = 0.1;
constexpr double kMass = 1.0;
constexpr double kFriction = 0.4;

struct RoundBody {
  std::string name;
  SurfaceMesh mesh;
  Eigen::Matrix3d turn;  ///< that it lies with
  double inertia;        ///< about its axis over m R^2
};

RoundBody rollingSphere() {
  return {"sphere", makeSphere(kRadius, 1e-4), Eigen::Matrix3d::Identity(), 0.4};
}

RoundBody rollingCylinder() {
  const Eigen::AngleAxisd lying(0.5 * kPi, Eigen::Vector3d::UnitX());
  return {"cylinder", makeCylinder(kRadius, 0.1, 1e-5), lying.toRotationMatrix(), 0.5};
}

/// The body on the ground, touching it by its lowest vertex.
ContactStage rollingStage(const RoundBody& body, double rolling_friction = 0.0) {
  ContactStage stage;
  stage.material.rolling_friction = rolling_friction;
  stage.material.static_friction = stage.material.dynamic_friction = kFriction;
  stage.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  stage.addGround();
  Eigen::Isometry3d pose = at(0, 0, depthOfLowestVertex(body.mesh, body.turn));
  pose.linear() = body.turn;
  SimulatedBodySettings& settings = stage.addFree(body.name, body.mesh, kMass, pose);
  // The mass properties are those of the round body, not of its mesh.
  MassProperties mass;
  mass.mass = kMass;
  const double across = body.name == "sphere" ? 0.4 : 0.25 + 0.1 * 0.1 / (12.0 * kRadius * kRadius);
  mass.inertia = kMass * kRadius * kRadius * Eigen::Vector3d(across, across, body.inertia).asDiagonal();
  settings.mass.reset();
  settings.inertia = mass;
  stage.letMeet("ground", body.name);
  return stage;
}

/// From rest, without slip: a = g sin / (1 + I / (m R^2)).
void rollsDown(SceneReport& report, const RoundBody& body) {
  const double angle = 0.2;
  const double duration = 1.0;
  ContactStage stage = rollingStage(body);
  stage.settings.gravity = kGravity * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  SceneRun run(stage.simulation(), duration, report);
  run.advanceTo(duration);
  const bool complete = !run.step();
  const double expected = kGravity * std::sin(angle) / (1.0 + body.inertia);
  report.equals({"acceleration of a " + body.name + " down a slope of 0.2", "m/s^2",
                 complete ? run.body(1).velocity.x() / run.time() : kNotComputed},
                expected, 0.02 * expected, "g sin / (1 + I/(m R^2))", run.figures());
}

/// Slides with v0, without spin: friction turns it until it rolls with v0 / (1 + I / (m R^2)).
void slidesUntilItRolls(SceneReport& report, const RoundBody& body) {
  const double speed = 1.0;
  const double changes = speed * body.inertia / ((1.0 + body.inertia) * kFriction * kGravity);
  ContactStage stage = rollingStage(body);
  stage.settings.bodies.back().velocity = {speed, 0.0, 0.0};
  const double duration = 2.0 * changes;
  SceneRun run(stage.simulation(), duration, report);
  run.advanceTo(duration);
  const bool complete = !run.step();
  const double expected = speed / (1.0 + body.inertia);
  report.equals({"speed of a " + body.name + " that slid with 1 m/s and rolls", "m/s",
                 complete ? run.body(1).velocity.x() : kNotComputed},
                expected, 0.02 * expected, "v0 / (1 + I/(m R^2))", run.figures());
}

constexpr double kRollingFriction = 5e-3;  // metres

/// a = g (b/R) / (1 + I / (m R^2)) holds it back.
void rollsOut(SceneReport& report, const RoundBody& body) {
  const double speed = 0.5;
  ContactStage stage = rollingStage(body, kRollingFriction);
  stage.settings.bodies.back().velocity = {speed, 0.0, 0.0};
  stage.settings.bodies.back().angular_velocity = {0.0, speed / kRadius, 0.0};
  const double deceleration = kGravity * kRollingFriction / kRadius / (1.0 + body.inertia);
  const double duration = 1.5 * speed / deceleration;
  SceneRun run(stage.simulation(), duration, report);
  run.advanceTo(duration);
  const bool complete = !run.step();
  const double expected = 0.5 * speed * speed / deceleration;
  report.equals({"way of a " + body.name + " that rolls with 0.5 m/s to rest", "m",
                 complete ? run.body(1).centre.x() : kNotComputed},
                expected, 0.02 * expected, "v^2 / (2 g b/R) (1 + I/(m R^2))", run.figures());
}

/// On a slope of 0.9 of the angle whose tangent is b/R.
void isHeldOnASlope(SceneReport& report, const RoundBody& body) {
  const double angle = 0.9 * std::atan(kRollingFriction / kRadius);
  ContactStage stage = rollingStage(body, kRollingFriction);
  stage.settings.gravity = kGravity * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  const double duration = 10.0;
  SceneRun run(stage.simulation(), duration, report);
  run.advanceTo(0.5 * duration);
  const Eigen::Vector3d place = run.body(1).centre;
  double largest = 0.0;
  while (run.step()) largest = std::max(largest, (run.body(1).centre - place).norm());
  report.atMost({"how far a " + body.name + " creeps on a slope below atan(b/R) in 5 s", "um", 1e6 * largest},
                1.0, "it stands still", run.figures());
}

/// A ball stands on the lowest vertex of its mesh.
void ballOnVertex(SceneReport& report) {
  const RoundBody body = {"sphere", makeSphere(kRadius, 0.01 * kRadius), Eigen::Matrix3d::Identity(), 0.4};
  ContactStage stage = rollingStage(body);
  const double duration = 10.0;
  SceneRun run(stage.simulation(), duration, report);
  double largest = 0.0;
  while (run.step()) largest = std::max(largest, run.body(1).centre.head<2>().norm());
  report.atMost({"how far a meshed ball rolls off its vertex in 10 s", "mm", 1e3 * largest}, 1.0,
                "a ball stays where it is put", run.figures());
}

/// An exact ball, turned anyhow.
void exactBall(SceneReport& report) {
  ContactStage stage;
  stage.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  stage.addGround();
  RoundShape shape;
  shape.radius = kRadius;
  shape.chord_error = 0.01 * kRadius;
  Eigen::Isometry3d pose = at(0, 0, kRadius);
  pose.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0).toRotationMatrix();
  stage.addFree("ball", shape, kMass, pose);
  stage.letMeet("ground", "ball");
  SceneRun run(stage.simulation(), 10.0, report);
  double largest = 0.0;
  while (run.step()) largest = std::max(largest, run.body(1).centre.head<2>().norm());
  report.atMost({"how far an exact ball rolls in 10 s", "mm", 1e3 * largest}, 1e-3,
                "a ball stays where it is put", run.figures());
}

}  // namespace

ContactScenes rollingScenes() {
  return {
      {"ball_on_vertex", "a meshed ball at rest", ballOnVertex},
      {"exact_ball", "an exact ball at rest", exactBall},
      {"rolling_cylinder", "down a slope", [](SceneReport& r) { rollsDown(r, rollingCylinder()); }},
      {"rolling_sphere", "down a slope", [](SceneReport& r) { rollsDown(r, rollingSphere()); }},
      {"rolling_out_cylinder", "rolling friction stops it",
       [](SceneReport& r) { rollsOut(r, rollingCylinder()); }},
      {"rolling_out_sphere", "rolling friction stops it",
       [](SceneReport& r) { rollsOut(r, rollingSphere()); }},
      {"held_sphere", "on a slope, by rolling friction",
       [](SceneReport& r) { isHeldOnASlope(r, rollingSphere()); }},
      {"sliding_cylinder", "until it rolls",
       [](SceneReport& r) { slidesUntilItRolls(r, rollingCylinder()); }},
      {"sliding_sphere", "until it rolls", [](SceneReport& r) { slidesUntilItRolls(r, rollingSphere()); }}};
}

}  // namespace concave_distance::benchmark
