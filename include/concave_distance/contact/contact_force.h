#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/normal_force.h"

namespace concave_distance {

/// Linear and angular velocity of B relative to A, of the point of B at A's origin, in A's frame.
struct RelativeTwist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< rad/s

  Eigen::Vector3d at(const Eigen::Vector3d& point_in_a) const { return linear + angular.cross(point_in_a); }
};

/// A force with its moment about a point.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m

  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    torque += other.torque;
    return *this;
  }
};

/// The wrench of a force at `point`, about `about`.
inline Wrench wrenchAbout(const Eigen::Vector3d& force, const Eigen::Vector3d& point,
                          const Eigen::Vector3d& about) {
  return {force, (point - about).cross(force)};
}

/// Of a contact, where a force acts and how the bodies move there.
struct ContactPoint {
  Eigen::Vector3d point_in_a;   ///< where the force acts
  Eigen::Vector3d normal_in_a;  ///< unit, from A to B
  ContactGeometry geometry;     ///< its depth_rate follows from the velocity: see relativeMotionAt
  Eigen::Vector3d sliding_in_a = Eigen::Vector3d::Zero();  ///< B's velocity against A across the normal
};

/// Sets depth_rate and sliding_in_a from the bodies' motion.
void setRelativeMotion(const RelativeTwist& b_in_a, ContactPoint& contact);

/// The two parts of the force on B at a contact, newtons, A's frame; A gets the opposite.
struct ContactForce {
  double normal = 0.0;  ///< along normal_in_a, >= 0
  Eigen::Vector3d friction_in_a = Eigen::Vector3d::Zero();
};

/// @param step seconds since the last call with this state, for the bristles
ContactForce contactForce(const NormalForceSettings& normal, const FrictionSettings& friction,
                          const ContactMaterial& material, const ContactPoint& contact, double step,
                          BristleState& state);

}  // namespace concave_distance
