#pragma once

#include <Eigen/Geometry>

#include "concave_distance/base/eigen_alignment.h"

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

/// The same wrench about `point`, given about the origin.
inline Wrench movedTo(const Eigen::Vector3d& point, const Wrench& about_origin) {
  return {about_origin.force, about_origin.torque - point.cross(about_origin.force)};
}

}  // namespace concave_distance
