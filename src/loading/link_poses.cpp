#include "link_poses.h"

#include <algorithm>
#include <cstddef>

namespace concave_distance::detail {
namespace {

constexpr double kTurn = 3.141592653589793;

// A mimic joint has the position of the joint it follows; chains end after as many steps as joints.
double positionOf(const RobotDescription& robot, const JointPositions& positions, std::size_t index) {
  double factor = 1.0;
  double offset = 0.0;
  for (std::size_t step = 0; step < robot.joints.size(); ++step) {
    const RobotJoint& joint = robot.joints[index];
    if (joint.mimicked.empty()) break;
    const auto followed = std::find_if(robot.joints.begin(), robot.joints.end(),
                                       [&](const RobotJoint& other) { return other.name == joint.mimicked; });
    if (followed == robot.joints.end()) return 0.0;
    offset += factor * joint.mimic_offset;
    factor *= joint.mimic_factor;
    index = static_cast<std::size_t>(followed - robot.joints.begin());
  }
  return factor * positions[index] + offset;
}

Eigen::Isometry3d motionOf(const RobotJoint& joint, double position) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (joint.motion == JointMotion::Turns) motion.linear() = Eigen::AngleAxisd(position, joint.axis).matrix();
  if (joint.motion == JointMotion::Slides) motion.translation() = position * joint.axis;
  return motion;
}

}  // namespace

JointPositions zeroPositions(const RobotDescription& robot) {
  JointPositions positions;
  for (const RobotJoint& joint : robot.joints) {
    const bool holds_zero = !joint.has_limits || (joint.lower <= 0.0 && joint.upper >= 0.0);
    positions.push_back(holds_zero ? 0.0 : 0.5 * (joint.lower + joint.upper));
  }
  return positions;
}

JointPositions randomPositions(const RobotDescription& robot, RandomEngine& engine) {
  JointPositions positions;
  for (const RobotJoint& joint : robot.joints) {
    const double share = uniformUnit(engine);
    if (joint.motion == JointMotion::None) {
      positions.push_back(0.0);
    } else if (joint.has_limits) {
      positions.push_back(joint.lower + share * (joint.upper - joint.lower));
    } else {
      positions.push_back(joint.motion == JointMotion::Turns ? kTurn * (2.0 * share - 1.0) : 0.0);
    }
  }
  return positions;
}

std::unordered_map<std::string, Eigen::Isometry3d> linkPoses(const RobotDescription& robot,
                                                             const JointPositions& positions) {
  std::unordered_map<std::string, Eigen::Isometry3d> poses;
  std::unordered_map<std::string, std::size_t> joint_above;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) joint_above[robot.joints[i].child] = i;
  for (const RobotLink& link : robot.links) {
    // From the link up to one whose pose is known, then down again.
    std::vector<std::size_t> chain;
    std::string name = link.name;
    while (poses.count(name) == 0 && joint_above.count(name) != 0 && chain.size() < robot.joints.size()) {
      chain.push_back(joint_above[name]);
      name = robot.joints[chain.back()].parent;
    }
    Eigen::Isometry3d pose = poses.count(name) != 0 ? poses[name] : Eigen::Isometry3d::Identity();
    poses.emplace(name, pose);
    for (auto index = chain.rbegin(); index != chain.rend(); ++index) {
      const RobotJoint& joint = robot.joints[*index];
      pose = pose * joint.parent_from_joint * motionOf(joint, positionOf(robot, positions, *index));
      poses[joint.child] = pose;
    }
  }
  return poses;
}

}  // namespace concave_distance::detail
