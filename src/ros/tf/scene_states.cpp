#include "scene_states.h"

#include <algorithm>
#include <utility>

#include "tf_poses.h"

namespace concave_distance {

void SceneStates::setScene(std::shared_ptr<const SceneKinematics> joints,
                           const std::string& reference_frame) {
  joints_ = std::move(joints);
  reference_frame_ = reference_frame;
  state_ = joints_->startState();
  is_known_.clear();
  for (const auto& robot : joints_->robots()) is_known_.emplace_back(robot->linkNames().size(), false);
}

void SceneStates::update(const tf2::BufferCore& buffer, const FramePoses& frames) {
  problems_.clear();
  for (std::size_t robot = 0; robot < joints_->robots().size(); ++robot) placeRobot(buffer, frames, robot);
  const BodyPoses& poses = frames.poses();
  for (std::size_t body = 0; body < joints_->bodyCount(); ++body) {
    std::optional<Eigen::Isometry3d>& pose = state_.world_from_body[body];
    const bool is_located = frames.place(body).status == TransformStatus::Ok;
    if (const auto& place = joints_->placeOf(body)) {
      if (!is_located || !is_known_[place->robot][place->link]) pose.reset();
    } else if (is_located && poses.newest[body] != BodyPoses::kUnknown) {
      const std::int32_t newest = poses.newest[body];
      pose = poses.pose(body, newest < 0 ? 0 : static_cast<std::size_t>(newest));
    } else {
      pose.reset();
    }
  }
}

void SceneStates::placeRobot(const tf2::BufferCore& buffer, const FramePoses& frames, std::size_t robot) {
  const RobotKinematics& kinematics = *joints_->robots()[robot];
  ros::Time stamp;
  for (std::size_t body = 0; body < joints_->bodyCount(); ++body) {
    const auto& place = joints_->placeOf(body);
    if (!place || place->robot != robot || frames.place(body).status != TransformStatus::Ok) continue;
    const ros::Time newest = frames.place(body).stamp;
    if (!newest.isZero() && (stamp.isZero() || newest < stamp)) stamp = newest;
  }
  std::vector<bool>& known = is_known_[robot];
  std::fill(known.begin(), known.end(), true);
  bool is_reported = false;
  for (std::size_t link = 0; link < known.size(); ++link) {
    if (!kinematics.isTaken(link)) continue;
    const FrameTransform found = lookUpFrame(buffer, reference_frame_, kinematics.linkNames()[link], stamp);
    known[link] = found.status == TransformStatus::Ok;
    if (known[link]) {
      state_.robots[robot].world_from_link[link] = found.target_from_source;
    } else if (!std::exchange(is_reported, true)) {
      problems_.push_back("robot '" + kinematics.name() + "': no pose of link '" +
                          kinematics.linkNames()[link] + "': " + found.message);
    }
  }
  for (std::size_t link = 1; link < known.size(); ++link) {
    if (!known[kinematics.parentOf(link)]) known[link] = false;
  }
  kinematics.takeLinks(state_.robots[robot]);
  joints_->placeBodies(robot, state_);
}

}  // namespace concave_distance
