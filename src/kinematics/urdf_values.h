#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>

#include "robot_joint.h"

namespace concave_distance::detail {

// Conversions of urdfdom's values.

Eigen::Isometry3d toIsometry(const urdf::Pose& pose);
RobotJoint toJoint(const urdf::Joint& given);

}  // namespace concave_distance::detail
