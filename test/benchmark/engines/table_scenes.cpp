#include <algorithm>
#include <cmath>

#include "benchmark/engines/engine_table.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

Eigen::Vector3d meanPlace(const Trajectory& body, double from, double until) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const EngineSample& sample : body) {
    if (sample.time < from || sample.time > until) continue;
    sum += sample.centre;
    count += 1.0;
  }
  return sum / count;
}

/// Largest of all bodies between the means of a second from `settled` on and of the last second, um.
std::function<double(const TableRun&)> drift(double settled, double duration) {
  return [=](const TableRun& run) {
    if (!run.complete) return kNotComputed;
    double largest = 0.0;
    for (const Trajectory& body : run.bodies) {
      const Eigen::Vector3d change =
          meanPlace(body, duration - 1.0, duration) - meanPlace(body, settled, settled + 1.0);
      largest = std::max(largest, change.norm());
    }
    return 1e6 * largest;
  };
}

TableScene cornerScene() {
  TableScene scene{"corner_at_rest", "drift from 3 s to 10 s", "um", "at rest"};
  scene.stage = bedStage(FrictionModel::Bristle);
  scene.stage.addFixed("corner", makeInnerCorner(), at(0, 0, 0));
  AppliedLoad push;
  push.force = {-20.0, 0.0, 0.0};
  scene.stage.addFree("box", makeBox({0.1, 0.1, 0.1}), 4.0, at(0.05, 0, 0.05)).loads = {push};
  scene.stage.letMeet("corner", "box");
  scene.shapes = {TableShape::Mesh, TableShape::Box};
  scene.spring_spacing = 0.05;
  scene.duration = 10.0;
  scene.figure = drift(3.0, scene.duration);
  return scene;
}

TableScene discScene() {
  TableScene scene{"spinning_disc", "time until 99 % of the spin is lost", "s", "3/4 R w / (mu g) of 99 %"};
  const double spin = 10.0;
  scene.radius = 0.1;
  scene.stage = bedStage(FrictionModel::Bristle);
  scene.stage.material.static_friction = scene.stage.material.dynamic_friction = 0.4;
  scene.stage.addGround();
  scene.stage.addFree("disc", makeCylinder(scene.radius, 0.02, 1e-4), 1.0, at(0, 0, 0.01))
      .angular_velocity = {0.0, 0.0, spin};
  scene.stage.letMeet("ground", "disc");
  scene.shapes = {TableShape::HalfSpace, TableShape::Cylinder};
  scene.spring_spacing = 0.01;
  scene.expected = 0.99 * 0.75 * scene.radius * spin / (0.4 * kGravity);
  scene.figure = [spin](const TableRun& run) {
    for (const EngineSample& sample : run.bodies[1]) {
      if (sample.angular_velocity.z() < 0.01 * spin) return sample.time;
    }
    return kNotComputed;
  };
  return scene;
}

TableScene towerScene() {
  TableScene scene{"stack_of_three", "largest drift of a box from 3 s to 10 s", "um", "at rest"};
  scene.stage = bedStage(FrictionModel::Bristle);
  scene.stage.addGround();
  scene.stage.addTower(3, 0.1, 1.0);
  scene.shapes = {TableShape::HalfSpace, TableShape::Box, TableShape::Box, TableShape::Box};
  scene.spring_spacing = 0.05;
  scene.duration = 10.0;
  scene.figure = drift(3.0, scene.duration);
  return scene;
}

TableScene heavyScene() {
  TableScene scene{"heavy_on_light", "largest drift of 100 kg on 0.1 kg from 1 s to 3 s", "um", "at rest"};
  scene.stage = bedStage(FrictionModel::Bristle);
  scene.stage.effects.normal_force->foundation_stiffness = 2e8;
  scene.stage.addGround();
  scene.stage.addTower(1, 0.1, 0.1);
  scene.stage.addFree("heavy", makeBox({0.1, 0.1, 0.1}), 100.0, at(0, 0, 0.15));
  scene.stage.letMeet("box_0", "heavy");
  scene.shapes = {TableShape::HalfSpace, TableShape::Box, TableShape::Box};
  scene.spring_spacing = 0.05;
  scene.duration = 3.0;
  scene.figure = drift(1.0, scene.duration);
  return scene;
}

/// Of the centre after the third bounce.
double thirdApex(const TableRun& run) {
  const Trajectory& ball = run.bodies[1];
  int apexes = 0;
  for (std::size_t i = 1; i < ball.size(); ++i) {
    if (!(ball[i - 1].velocity.z() > 0.0) || ball[i].velocity.z() > 0.0) continue;
    if (++apexes == 3) return ball[i].centre.z() + 0.5 * std::pow(ball[i].velocity.z(), 2) / kGravity;
  }
  return kNotComputed;
}

TableScene steelScene() {
  TableScene scene{"steel_ball", "height of the centre after the third bounce", "m", "no loss"};
  scene.radius = 0.02;
  scene.stage.material.youngs_modulus = 2.1e11;
  scene.stage.material.poissons_ratio = 0.3;
  scene.stage.material.dissipation = 0.0;
  scene.stage.effects = effectsOf(NormalForceModel::Hertz);
  scene.stage.addGround();
  const double mass = 7850.0 * 4.0 / 3.0 * kPi * std::pow(scene.radius, 3);
  scene.stage.addFree("ball", makeSphere(scene.radius, 0.01 * scene.radius), mass, at(0, 0, 0.4));
  scene.stage.letMeet("ground", "ball");
  scene.shapes = {TableShape::HalfSpace, TableShape::Sphere};
  scene.restitution = 1.0;
  scene.duration = 2.2;
  scene.expected = 0.4;
  scene.figure = thirdApex;
  return scene;
}

TableScene wallScene() {
  const double speed = 20.0;
  TableScene scene{"thin_wall", "speed away from a wall of 1 mm", "m/s",
                   "no loss; through the wall: below 0"};
  scene.radius = 0.05;
  scene.stage.material.dissipation = 0.0;
  scene.stage.effects = effectsOf(NormalForceModel::ElasticFoundation);
  scene.stage.effects.normal_force->foundation_stiffness = 1e12;
  scene.stage.addFixed("wall", makeBox({0.4, 0.4, 0.001}), at(0, 0, -0.0005));
  scene.stage.addFree("ball", makeSphere(scene.radius, 0.0005), 0.5, at(0, 0, 0.06)).velocity = {0, 0,
                                                                                                 -speed};
  scene.stage.letMeet("wall", "ball");
  scene.stage.settings.gravity.setZero();
  scene.shapes = {TableShape::Box, TableShape::Sphere};
  scene.spring_spacing = 0.005;
  scene.restitution = 1.0;
  scene.duration = 0.01;
  scene.expected = speed;
  scene.figure = [](const TableRun& run) {
    return run.complete ? run.bodies[1].back().velocity.z() : kNotComputed;
  };
  return scene;
}

TableScene rollingScene() {
  TableScene scene{"rolling_sphere", "acceleration down a slope of 0.2", "m/s^2", "5/7 g sin"};
  const double angle = 0.2;
  scene.radius = 0.1;
  scene.stage.material.static_friction = scene.stage.material.dynamic_friction = 0.4;
  scene.stage.effects = effectsOf(NormalForceModel::HuntCrossley, FrictionModel::Bristle);
  scene.stage.addGround();
  SimulatedBodySettings& ball =
      scene.stage.addFree("ball", makeSphere(scene.radius, 1e-4), 1.0, at(0, 0, scene.radius));
  ball.mass.reset();
  MassProperties mass;
  mass.inertia = 0.4 * scene.radius * scene.radius * Eigen::Matrix3d::Identity();
  ball.inertia = mass;
  scene.stage.letMeet("ground", "ball");
  scene.stage.settings.gravity = kGravity * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  scene.shapes = {TableShape::HalfSpace, TableShape::Sphere};
  scene.duration = 1.0;
  scene.expected = 5.0 / 7.0 * kGravity * std::sin(angle);
  scene.figure = [](const TableRun& run) {
    return run.complete ? run.bodies[1].back().velocity.x() / run.bodies[1].back().time : kNotComputed;
  };
  return scene;
}

}  // namespace

std::vector<TableScene> tableScenes() {
  return {cornerScene(), discScene(), towerScene(), heavyScene(), steelScene(), wallScene(), rollingScene()};
}

}  // namespace concave_distance::benchmark
