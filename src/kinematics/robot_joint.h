#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace concave_distance::detail {

enum class JointType : std::uint8_t { Fixed, Revolute, Continuous, Prismatic, Planar, Floating };

/// A joint as a URDF says it; link names have no leading slash.
struct RobotJoint {
  std::string name;
  std::string parent;
  std::string child;
  JointType type = JointType::Fixed;
  Eigen::Isometry3d parent_from_joint = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< as given, joint frame; of a planar joint the normal
  bool has_limits = false;
  double lower = 0.0;  ///< rad or m
  double upper = 0.0;
  std::string mimicked;  ///< the joint it follows; empty: none
  double mimic_factor = 1.0;
  double mimic_offset = 0.0;
};

/// The links and joints of a robot, in the order of the URDF.
struct RobotStructure {
  std::string name;
  std::vector<std::string> links;  ///< without a leading slash
  std::vector<RobotJoint> joints;
};

}  // namespace concave_distance::detail
