#pragma once

#include <Eigen/Geometry>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/random_engine.h"
#include "robot_description.h"

namespace concave_distance::detail {

/// Positions of a robot's joints, in their order: rad or m; 0 for fixed joints.
using JointPositions = std::vector<double>;

/// Every joint at zero, or in the middle of its range if zero is outside.
JointPositions zeroPositions(const RobotDescription& robot);

/// Every joint at random within its limits; joints without limits within one turn.
JointPositions randomPositions(const RobotDescription& robot, RandomEngine& engine);

/// Poses of the links in the frame of the root link, by their names. Joints of more than one
/// degree of freedom stay at zero.
std::unordered_map<std::string, Eigen::Isometry3d> linkPoses(const RobotDescription& robot,
                                                             const JointPositions& positions);

}  // namespace concave_distance::detail
