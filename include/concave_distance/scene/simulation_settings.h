#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "concave_distance/mesh/surface/mass_properties.h"

namespace concave_distance {

/// A pose at a time, seconds, world.
struct TimedPose {
  double time = 0.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// A constant force and torque on a body over a time span.
struct AppliedLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();          ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();         ///< N m
  Eigen::Vector3d point_in_body = Eigen::Vector3d::Zero();  ///< where the force acts
  bool in_body_frame = false;                               ///< else world axes
  double from = 0.0;                                        ///< seconds
  double until = std::numeric_limits<double>::infinity();   ///< seconds
};

/// A spring and damper of six degrees of freedom between a frame of a body and a target that moves. Axes are
/// the target's; the rotational spring acts on the rotation vector.
struct CompliantDrive {
  Eigen::Isometry3d body_from_drive = Eigen::Isometry3d::Identity();
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();             ///< N/m, >= 0
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();               ///< N s/m, >= 0
  Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero();  ///< N m/rad, >= 0
  Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();    ///< N m s/rad, >= 0
  std::vector<TimedPose> target;                                   ///< of the drive frame, world; ascending
};

enum class BodyMotion : std::uint8_t {
  Fixed,   ///< stays where it is
  Driven,  ///< goes along its path, whatever acts on it
  Free     ///< moved by forces
};
std::string_view toString(BodyMotion motion);

struct SimulatedBodySettings {
  std::string body;   ///< name in the scene
  std::string where;  ///< place in the file, for messages
  BodyMotion motion = BodyMotion::Free;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();      ///< of the body's frame, world, at time 0
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< of the centre of mass, world, m/s
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< world axes, rad/s
  /// A free body may give one of these; without any, it has what the URDF says of its link.
  std::optional<MassProperties> inertia;
  std::optional<double> density;  ///< kg/m^3, closed meshes only
  std::optional<double> mass;     ///< kg, spread evenly, closed meshes only
  std::vector<TimedPose> path;    ///< of a driven body's frame, world; ascending
  std::optional<CompliantDrive> drive;
  std::vector<AppliedLoad> loads;
};

/// Says what a simulation follows of a pair besides the proven distance.
enum class SimulationTracking : std::uint8_t {
  Niches,         ///< every local minimum
  SingleMinimum,  ///< the last cycle's closest pair alone, moved downhill
  Both            ///< to compare them
};
std::string_view toString(SimulationTracking tracking);

/// The section `simulation` of a scene file (doc/scene_file.md). Bodies that it does not name are fixed at
/// the origin of the world.
struct SimulationSettings {
  Eigen::Vector3d gravity = Eigen::Vector3d(0.0, 0.0, -9.81);  ///< m/s^2
  double duration = 1.0;                                       ///< seconds
  double largest_step = 1e-2;                                  ///< seconds
  /// A step takes at most this share of sqrt(m / k) of contacts and drives that swing, and of a radian. What
  /// is at rest in them holds no step back.
  double step_fraction = 0.1;
  /// Any point may move at most this far beyond the proven distance against the other body in one step,
  /// metres: nothing thicker is passed through unseen; 0, and while the bodies are apart where it is less: a
  /// share of the depth that the next contact reaches by its stiffness, mass and speed.
  double allowed_penetration = 0.0;
  /// Error that one step may make, as a share of the work that the contact or drive does in it; five times as
  /// much of friction's. The default is half of what pressures are sampled to.
  double work_tolerance = 5e-4;
  /// Error of the energy balance, as a share of the energy that went through, above which a run has failed.
  double energy_tolerance = 0.05;
  double log_rate = 100.0;  ///< lines a second of simulated time
  SimulationTracking tracking = SimulationTracking::Niches;
  std::vector<SimulatedBodySettings> bodies;

  /// Checks what shows in the numbers alone. @throws Error naming the parameter, the value seen and
  /// what is allowed
  void validate(const std::string& where) const;
};

}  // namespace concave_distance
