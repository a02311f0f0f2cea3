#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "concave_distance/kinematics/robot_kinematics.h"

namespace concave_distance::test {

inline std::string packageFile(const std::string& name) {
  std::ifstream file(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string movingJoint(const std::string& name, const std::string& type, const std::string& parent,
                               const std::string& child, const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><limit lower='-0.5' upper='2' effort='1' velocity='1'/>" + more + "</joint>";
}

/// A robot with every type of joint and a chain of mimics; its fingers are concave brackets.
inline std::string mobileRobot() {
  const auto box = [](const std::string& size, const std::string& xyz) {
    return "<collision><origin xyz='" + xyz + "'/><geometry><box size='" + size +
           "'/></geometry></collision>";
  };
  const auto link = [](const std::string& name, const std::string& content) {
    return "<link name='" + name + "'>" + content + "</link>";
  };
  return "<robot name='mobile'>" + link("hall", "") + link("base", box("0.6 0.4 0.2", "0 0 0.1")) +
         link("lift", box("0.1 0.1 0.6", "0 0 0.3")) + link("arm", box("0.5 0.08 0.08", "0.25 0 0")) +
         link("wrist", "") + link("hand", box("0.05 0.3 0.05", "0 0 0")) +
         link("left", box("0.15 0.02 0.02", "0.075 0 0") + box("0.02 0.06 0.02", "0.14 -0.03 0")) +
         link("right", box("0.15 0.02 0.02", "0.075 0 0") + box("0.02 0.06 0.02", "0.14 0.03 0")) +
         link("thumb", box("0.1 0.02 0.02", "0.05 0 0.05")) + link("drone", box("0.2 0.2 0.05", "0 0 0")) +
         movingJoint("grip", "prismatic", "hand", "left",
                     "<origin xyz='0.02 0.1 0' rpy='0.1 0 0'/><axis xyz='0 0.2 0'/>") +
         movingJoint("drive", "planar", "hall", "base",
                     "<origin rpy='0.2 -0.1 0.3'/><axis xyz='0.1 0.2 2'/>") +
         movingJoint("raise", "prismatic", "base", "lift", "<origin xyz='0.1 0 0.2'/><axis xyz='0 0 1'/>") +
         movingJoint("swing", "revolute", "lift", "arm",
                     "<origin xyz='0 0.1 0.5' rpy='0.3 0.2 0.1'/><axis xyz='1 -2 0.5'/>") +
         movingJoint("bolt", "fixed", "arm", "wrist", "<origin xyz='0.5 0 0' rpy='0 0.7 0'/>") +
         movingJoint("roll", "continuous", "wrist", "hand", "<origin xyz='0.05 0 0'/><axis xyz='1 0 0'/>") +
         movingJoint("grip2", "prismatic", "hand", "right",
                     "<origin xyz='0.02 -0.1 0'/><axis xyz='0 1 0'/>"
                     "<mimic joint='grip' multiplier='-1' offset='0.01'/>") +
         movingJoint("grip3", "revolute", "hand", "thumb",
                     "<axis xyz='0 0 1'/><mimic joint='grip2' multiplier='0.5' offset='-0.02'/>") +
         movingJoint("fly", "floating", "hall", "drone", "<origin xyz='0 1 2' rpy='0.1 0.2 0.3'/>") +
         "</robot>";
}

/// Positions at random: in their ranges, else within a turn or a metre.
inline Eigen::VectorXd randomPositions(const RobotKinematics& robot, std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Eigen::VectorXd positions = robot.restPositions();
  const Eigen::VectorXd lowest = robot.lowestPositions();
  const Eigen::VectorXd highest = robot.highestPositions();
  for (Eigen::Index i = 0; i < positions.size(); ++i) {
    const double reach = robot.isAngle(static_cast<std::size_t>(i)) ? 3.0 : 1.0;
    const bool is_limited = lowest[i] > -1e9;
    const double low = is_limited ? lowest[i] : -reach;
    const double high = is_limited ? highest[i] : reach;
    positions[i] = low + unit(engine) * (high - low);
  }
  return positions;
}

/// Moves positions by a small step of one velocity; quaternions turn about the axes of the joint's frame.
inline Eigen::VectorXd stepped(const RobotKinematics& robot, const Eigen::VectorXd& positions,
                               std::size_t velocity, double step) {
  const std::string name = robot.velocityNames()[velocity];
  Eigen::VectorXd moved = positions;
  const auto index = [&](const std::string& wanted) {
    const auto& names = robot.positionNames();
    return std::find(names.begin(), names.end(), wanted) - names.begin();
  };
  const std::size_t mark = name.find("/rot_");
  if (mark == std::string::npos) {
    moved[index(name)] += step;
    return moved;
  }
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis[name.back() - 'x'] = 1.0;
  const Eigen::Index first = index(name.substr(0, mark) + "/rot_x");
  const Eigen::Quaterniond now(Eigen::Vector4d(positions.segment<4>(first)));
  moved.segment<4>(first) = (Eigen::Quaterniond(Eigen::AngleAxisd(step, axis)) * now.normalized()).coeffs();
  return moved;
}

}  // namespace concave_distance::test
