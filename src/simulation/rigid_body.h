#pragma once

#include <Eigen/Geometry>

#include "concave_distance/contact/wrench.h"
#include "concave_distance/mesh/surface/mass_properties.h"

namespace concave_distance {

/// Says where a free body is and how it moves. The angular momentum, and not the angular velocity, is the
/// state: without torques it is constant, whatever the body does.
struct RigidBodyState {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of mass, world, metres
  Eigen::Quaterniond world_from_principal = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< of the centre, world, m/s
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  ///< about the centre, world axes, kg m^2/s
};

/// Says what a drift did: how far the centre went, and how far the body turned in sum of all partial
/// turns. No point at radius r from the centre has left its place by more than |shift| + r turn at any
/// time in between.
struct Drift {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< metres
  double turn = 0.0;                                ///< rad, >= 0
  double norm_drift = 0.0;  ///< by which the quaternion's norm had left 1 before it was normalised
};

/// One free body: mass properties in principal axes, and the two exact flows that the integrator is made of.
class RigidBody {
 public:
  /// @throws Error naming `where` for impossible mass properties
  RigidBody(const MassProperties& properties, const std::string& where);

  double mass() const { return mass_; }
  const Eigen::Vector3d& centreInBody() const { return centre_in_body_; }
  const Eigen::Vector3d& principalMoments() const { return moments_; }  ///< ascending, kg m^2

  /// The state with the body's frame at this pose. @param velocity of the centre of mass, world, m/s
  RigidBodyState stateAt(const Eigen::Isometry3d& world_from_body, const Eigen::Vector3d& velocity,
                         const Eigen::Vector3d& angular_velocity) const;
  Eigen::Isometry3d worldFromBody(const RigidBodyState& state) const;
  Eigen::Vector3d angularVelocity(const RigidBodyState& state) const;  ///< world axes, rad/s
  double kineticEnergy(const RigidBodyState& state) const;             ///< J
  /// Change of the angular velocity, world axes, by a change of the angular momentum.
  Eigen::Vector3d turnOf(const RigidBodyState& state, const Eigen::Vector3d& angular_momentum) const;
  Eigen::Matrix3d inertia(const RigidBodyState& state) const;  ///< about the centre, world axes, kg m^2

  /// The impulse of a constant wrench about the centre, world axes, over `step` seconds.
  void kick(const Wrench& about_centre, double step, RigidBodyState& state) const;

  /// Free motion over `step` seconds. The rotation is split into exact turns about the principal axes,
  /// symmetrically (Dullweber, Leimkuhler, McLachlan 1997): symplectic, time-reversible, second order, the
  /// angular momentum in the world unchanged but for rounding, for every step size. The gyroscopic term needs
  /// no other treatment.
  Drift drift(double step, RigidBodyState& state) const;

 private:
  double mass_;
  Eigen::Vector3d centre_in_body_;
  Eigen::Vector3d moments_;
  Eigen::Quaterniond body_from_principal_;
};

}  // namespace concave_distance
