#pragma once

#include <Eigen/Geometry>

#include "concave_distance/loading/load_scene.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// A map of xyz and rpy, quaternion or rotation. @throws Error for what is wrong with it
Eigen::Isometry3d readPose(const YamlValue& value);

/// Takes the shape of a body from its map, or those of a list `shapes`; the caller calls finish().
/// @throws Error for what is wrong with one, and when there is none
void readShapes(YamlMap& map, BodyDescription& body);

}  // namespace concave_distance::detail
