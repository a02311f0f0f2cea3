#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "robot_joint.h"

namespace concave_distance::detail {

/// A joint that mimics another may be given this far from where that puts it, rad or m.
inline constexpr double kMimicTolerance = 1e-6;

/// A joint in the tree, whose child is the link behind its place: joint i moves link i + 1.
struct TreeJoint {
  RobotJoint given;
  std::size_t parent = 0;  ///< link
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  /// The columns are what a planar or floating joint slides along, joint frame; of a planar one the last is
  /// its normal.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  std::size_t first_position = 0;  ///< that it moves with: its own, or of the joint that it follows
  std::size_t first_velocity = 0;
  std::size_t position_count = 0;
  std::size_t velocity_count = 0;  ///< as many as axes
  std::size_t first_axis = 0;
  bool follows = false;
  double factor = 1.0;  ///< of the position that it moves with; 1 without one to follow
  double offset = 0.0;
};

/// The links and joints of a robot, from the root outwards, and where the numbers of each joint stand.
class RobotTree {
 public:
  /// @throws Error as RobotKinematics
  RobotTree(const RobotStructure& structure, const std::string& where, const std::string& prefix);

  /// Checks and orders named positions, as RobotKinematics::positionsOf().
  Eigen::VectorXd positionsOf(const std::vector<std::string>& names, const std::vector<double>& values) const;

  std::string name;
  std::string where;
  std::vector<std::string> links;  ///< with the prefix, parents first
  std::vector<bool> is_moved;      ///< of links
  std::unordered_map<std::string, std::size_t> link_of;
  std::vector<TreeJoint> joints;
  std::vector<std::string> joint_names;  ///< of joints, with the prefix
  std::vector<std::string> position_names;
  std::vector<std::string> velocity_names;
  std::vector<bool> is_angle;  ///< of positions
  std::vector<double> rest;
  std::vector<double> lowest;
  std::vector<double> highest;
  std::size_t axis_count = 0;

 private:
  void orderLinks(const RobotStructure& structure, const std::string& prefix);
  void setAxes(TreeJoint& joint) const;
  void addNumbers(TreeJoint& joint, const std::string& prefix);
  void follow(TreeJoint& joint, const std::string& prefix);
  const TreeJoint* findJoint(const std::string& prefixed) const;

  std::unordered_map<std::string, std::size_t> position_of_;
  std::unordered_map<std::string, std::size_t> joint_of_;  ///< without a prefix
  std::size_t prefix_length_ = 0;
};

}  // namespace concave_distance::detail
