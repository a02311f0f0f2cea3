#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/support/contact_stage.h"
#include "benchmark/support/stopwatch.h"

namespace concave_distance::benchmark {

/// What an engine with shapes of its own takes a body for.
enum class TableShape : std::uint8_t { HalfSpace, Box, Sphere, Cylinder, Mesh };

/// A body at one time; world frame.
struct EngineSample {
  double time = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the centre
  Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Identity();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< world axes, rad/s
};
using Trajectory = std::vector<EngineSample>;

/// How an engine went through a scene.
struct TableRun {
  std::vector<Trajectory> bodies;  ///< as in the scene, to the same sample
  double seconds = 0.0;            ///< of the wall clock
  bool complete = false;           ///< reached the scene's duration
};

/// A scene of several bodies with one figure that has a closed form.
struct TableScene {
  std::string name;
  std::string what;
  std::string unit;
  std::string formula;
  ContactStage stage{};              ///< of the first pair all engines take material and force
  std::vector<TableShape> shapes{};  ///< of its bodies; a half space is z <= 0
  double radius = 0.0;               ///< of spheres and cylinders, metres
  double spring_spacing = 0.0;       ///< longest edge of a bed of springs' mesh, metres; 0: no bed
  double restitution = 0.0;          ///< for engines that take a constant
  double duration = 1.0;             ///< seconds
  double expected = 0.0;
  std::function<double(const TableRun&)> figure{};

  ContactMaterial material() const { return stage.contactMaterial(); }
  const NormalForceSettings& normal() const { return *stage.effects.normal_force; }
  double friction() const;  ///< 0 where none is asked for
};

inline constexpr double kTableRate = 1000.0;  // samples a second
inline constexpr double kTableWall = 60.0;    // seconds that one run may take

std::vector<TableScene> tableScenes();

/// How an engine is run on a scene.
struct TableEngine {
  std::string name;
  std::function<TableRun(const TableScene&)> run;
};

TableRun runOwnTable(const TableScene& scene);
/// Flat faces by ElasticFoundationForce, balls by HuntCrossleyForce on half spaces.
std::vector<TableEngine> simbodyEngines();
/// Rigid contact as a complementarity problem (Dantzig), at two constant steps.
std::vector<TableEngine> odeEngines();
/// Rigid contact by sequential impulses, at two constant steps; none where Bullet is not installed.
std::vector<TableEngine> bulletEngines();

/// A scene in an engine of constant steps: `world` has step(seconds) and sample(time, trajectories).
template <typename World>
TableRun runInSteps(const TableScene& scene, World& world, double step) {
  TableRun run;
  run.bodies.resize(scene.shapes.size());
  world.sample(0.0, run.bodies);
  const auto samples = std::lround(scene.duration * kTableRate);
  const auto steps = std::max(1L, std::lround(1.0 / (kTableRate * step)));
  const auto start = std::chrono::steady_clock::now();
  for (long i = 1; i <= samples && run.seconds < kTableWall; ++i) {
    for (long k = 0; k < steps; ++k) world.step(1.0 / (kTableRate * static_cast<double>(steps)));
    run.seconds = 1e-6 * microsecondsSince(start);
    world.sample(static_cast<double>(i) / kTableRate, run.bodies);
    run.complete = i == samples;
  }
  return run;
}

/// An engine of constant steps, made as World(scene), at both steps.
template <typename World>
std::vector<TableEngine> atBothSteps(const std::string& engine) {
  const auto at = [&](const char* name, double step) -> TableEngine {
    return {engine + name, [step](const TableScene& scene) {
              World world(scene);
              return runInSteps(scene, world, step);
            }};
  };
  return {at(" 0.1 ms", 1e-4), at(" 1 ms", 1e-3)};
}

}  // namespace concave_distance::benchmark
