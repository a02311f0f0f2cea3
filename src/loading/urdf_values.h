#pragma once

#include <urdf_model/model.h>

#include <Eigen/Geometry>
#include <optional>

#include "concave_distance/mesh/surface/mass_properties.h"
#include "robot_description.h"

namespace concave_distance::detail {

// Conversions of urdfdom's values.

Eigen::Isometry3d toIsometry(const urdf::Pose& pose);
RobotJoint toJoint(const urdf::Joint& joint);

/// Returns the inertia about the centre of mass, in the link's axes: in the URDF the tensor has its own axes.
std::optional<MassProperties> inertiaOf(const urdf::Link& link);

}  // namespace concave_distance::detail
