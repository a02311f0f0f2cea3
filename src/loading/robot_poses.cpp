#include "concave_distance/loading/robot_poses.h"

#include <algorithm>
#include <utility>

#include "concave_distance/base/error.h"
#include "link_poses.h"

namespace concave_distance {

struct RobotPoses::Robot {
  detail::RobotDescription description;
  detail::JointPositions at_rest;
};

RobotPoses::RobotPoses(const std::string& urdf, const std::string& where)
    : robot_(std::make_unique<Robot>()) {
  robot_->description = detail::readRobotDescription(urdf, where, GeometrySource::Collision);
  robot_->at_rest = detail::zeroPositions(robot_->description);
}
RobotPoses::~RobotPoses() = default;
RobotPoses::RobotPoses(RobotPoses&&) noexcept = default;
RobotPoses& RobotPoses::operator=(RobotPoses&&) noexcept = default;

std::vector<std::string> RobotPoses::jointNames() const {
  std::vector<std::string> names;
  for (const detail::RobotJoint& joint : robot_->description.joints) {
    if (joint.motion != detail::JointMotion::None && joint.mimicked.empty()) names.push_back(joint.name);
  }
  return names;
}

std::vector<std::optional<Eigen::Isometry3d>> RobotPoses::of(
    const Scene& scene, const std::map<std::string, double>& positions) const {
  const std::vector<detail::RobotJoint>& joints = robot_->description.joints;
  detail::JointPositions all = robot_->at_rest;
  for (const auto& [name, position] : positions) {
    const auto found = std::find_if(joints.begin(), joints.end(), [&, &wanted = name](const auto& joint) {
      return joint.name == wanted && joint.motion != detail::JointMotion::None && joint.mimicked.empty();
    });
    if (found == joints.end()) {
      throw Error("joint '" + name + "'", "no joint of the robot has this name and moves by itself",
                  "take the names from jointNames()");
    }
    all[static_cast<std::size_t>(found - joints.begin())] = position;
  }
  const auto links = detail::linkPoses(robot_->description, all);
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  poses.reserve(scene.bodies.size());
  for (const SceneBody& body : scene.bodies) {
    const auto link = links.find(body.frame);
    poses.push_back(link == links.end() ? std::nullopt : std::optional(link->second));
  }
  return poses;
}

}  // namespace concave_distance
