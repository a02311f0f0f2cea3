#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/contact/material.h"
#include "concave_distance/mesh/surface/mass_properties.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance::benchmark {

/// What an engine with shapes of its own takes the free body for. The ground is the half space z <= 0.
enum class ComparedShape : std::uint8_t { Sphere, Box, Mesh };

/// One free body over the ground, as a scene file has it, with what other engines need said explicitly.
struct ComparedScene {
  std::string name;
  Scene scene;           ///< with its section `simulation`
  std::size_t body = 0;  ///< the free one, index into Scene::bodies
  ComparedShape shape = ComparedShape::Mesh;
  double radius = 0.0;                                     ///< of a sphere, metres
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();      ///< of a box, metres
  double spring_spacing = 0.0;                             ///< longest edge of a bed of springs' mesh, metres
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the body's frame at time 0
  MassProperties mass;
  ContactMaterial material{};
  double foundation_stiffness = 0.0;  ///< Pa/m; of a sphere unused
  double friction = 0.0;              ///< coefficient, static and dynamic
  /// For engines that take a constant: Hunt and Crossley's at the first impact; 0 for bodies at rest.
  double restitution = 0.0;

  const SimulationSettings& settings() const { return *scene.simulation; }
  const SurfaceMesh& surface() const { return scene.bodies[body].mesh->surface(); }
};

/// The free body at one time; world frame.
struct EngineSample {
  double time = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the centre
  Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Identity();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< world axes, rad/s

  /// About the y axis, for bodies that turn in the x-z plane, rad.
  double pitch() const { return std::atan2(world_from_body(0, 2), world_from_body(2, 2)); }
};

/// Kinetic and gravity's potential energy, joules; what a contact's springs hold is not in it.
double mechanicalEnergy(const ComparedScene& scene, const EngineSample& sample);

using Trajectory = std::vector<EngineSample>;

/// The scene's duration at `rate` samples a second, from time 0.
std::size_t sampleCount(const ComparedScene& scene, double rate);

/// How our own simulation runs a scene.
struct OwnOptions {
  double step_scale = 1.0;  ///< on the settings that bound a step
  /// Turns the body about its centre before the start, so that another place of its mesh hits.
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
};
Trajectory runOwn(const ComparedScene& scene, double rate, const OwnOptions& options = {});

/// Simbody (apt: libsimbody-dev): spheres by HuntCrossleyForce, meshes by ElasticFoundationForce, both on a
/// half space; Runge-Kutta-Merson with error control.
struct SimbodyOptions {
  /// Turns our material into the numbers that give the same law there; false: hands over each
  /// body's modulus and c as they are.
  bool convert = true;
  double accuracy = 1e-7;          ///< of the integrator, relative
  double transition_speed = 1e-3;  ///< of the friction, m/s
};
Trajectory runSimbody(const ComparedScene& scene, double rate, const SimbodyOptions& options = {});

/// The Open Dynamics Engine (apt: libode-dev): rigid contact with a coefficient of restitution and Coulomb's
/// friction, a complementarity problem a step (Dantzig), constant steps.
struct OdeOptions {
  double step = 1e-4;  ///< seconds; divides the time between samples
};
Trajectory runOde(const ComparedScene& scene, double rate, const OdeOptions& options = {});

/// The scenes by name: bouncing_ball, box_sticks, box_slides, box_slides_diagonally, two_feet.
/// @throws Error for a scene file of another form
std::vector<ComparedScene> comparedScenes();

}  // namespace concave_distance::benchmark
