#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <optional>

#include "concave_distance/mesh/mass_properties.h"
#include "robot_description.h"

namespace concave_distance::detail {

// urdfdom's values as this package has them.

Eigen::Isometry3d toIsometry(const urdf::Pose& pose);
RobotJoint toJoint(const urdf::Joint& joint);

/// About the centre of mass in the link's axes: the URDF has its own axes for the tensor.
std::optional<MassProperties> inertiaOf(const urdf::Link& link);

}  // namespace concave_distance::detail
