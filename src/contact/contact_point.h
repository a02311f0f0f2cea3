#pragma once

#include <Eigen/Core>

#include "concave_distance/contact/normal_force.h"
#include "concave_distance/contact/wrench.h"

namespace concave_distance {

/// Says where a force of a contact acts and how the bodies move there.
struct ContactPoint {
  Eigen::Vector3d point_in_a;   ///< where the force acts
  Eigen::Vector3d normal_in_a;  ///< unit, from A to B
  ContactGeometry geometry;     ///< its depth_rate follows from the velocity: see setRelativeMotion
  Eigen::Vector3d sliding_in_a = Eigen::Vector3d::Zero();  ///< B's velocity against A across the normal
};

/// Sets depth_rate and sliding_in_a from the bodies' motion.
void setRelativeMotion(const RelativeTwist& b_in_a, ContactPoint& contact);

}  // namespace concave_distance
