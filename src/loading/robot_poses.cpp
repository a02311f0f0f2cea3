#include "concave_distance/loading/robot_poses.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "concave_distance/base/error.h"
#include "frame_name.h"
#include "link_poses.h"

namespace concave_distance {

namespace {

std::string framesOf(const Scene& scene) {
  constexpr std::size_t kMostNamed = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(scene.bodies.size(), kMostNamed); ++i) {
    text += (i == 0 ? "'" : ", '") + scene.bodies[i].frame + "'";
  }
  return text + (scene.bodies.size() > kMostNamed ? ", ..." : "");
}

}  // namespace

struct RobotPoses::Robot {
  std::string where;
  std::string prefix;
  detail::RobotDescription description;
  detail::JointPositions at_rest;
};

RobotPoses::RobotPoses(const std::string& urdf, const std::string& where, const std::string& prefix)
    : robot_(std::make_unique<Robot>()) {
  robot_->where = where;
  robot_->prefix = withoutLeadingSlash(prefix);
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
    if (!std::isfinite(position))
      throw Error("joint '" + name + "'", "its position is not finite", "give rad or m");
    all[static_cast<std::size_t>(found - joints.begin())] = position;
  }
  std::unordered_map<std::string, Eigen::Isometry3d> links;
  for (const auto& [link, pose] : detail::linkPoses(robot_->description, all)) {
    links.emplace(robot_->prefix + link, pose);
  }
  bool any = scene.bodies.empty();
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  poses.reserve(scene.bodies.size());
  for (const SceneBody& body : scene.bodies) {
    const auto link = links.find(body.frame);
    poses.push_back(link == links.end()
                        ? std::nullopt
                        : std::optional<Eigen::Isometry3d>(link->second * body.frame_from_body));
    any = any || link != links.end();
  }
  if (!any) {
    throw Error(robot_->where,
                "no body of the scene is fixed to a link '" + robot_->prefix + "...' of robot '" +
                    robot_->description.name + "'; the bodies' frames are " + framesOf(scene),
                "give RobotPoses the URDF of the scene, and the prefix that the scene file gives the robot");
  }
  return poses;
}

}  // namespace concave_distance
