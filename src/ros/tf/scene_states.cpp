#include "scene_states.h"

#include <algorithm>
#include <utility>

namespace concave_distance {

void SceneStates::setScene(std::shared_ptr<const SceneKinematics> joints,
                           const std::string& reference_frame) {
  joints_ = std::move(joints);
  reference_frame_ = reference_frame;
  state_ = joints_->startState();
  is_known_.clear();
  for (const auto& robot : joints_->robots()) is_known_.emplace_back(robot->linkNames().size(), false);
}

void SceneStates::update(TfLocate& locate) {
  problems_.clear();
  for (std::size_t robot = 0; robot < joints_->robots().size(); ++robot) placeRobot(locate, robot);
  for (std::size_t body = 0; body < joints_->bodyCount(); ++body) {
    const std::optional<Eigen::Isometry3d>& seen = locate.poses()[body];
    std::optional<Eigen::Isometry3d>& pose = state_.world_from_body[body];
    const auto& place = joints_->placeOf(body);
    if (!place) {
      pose = seen;
    } else if (!seen || !is_known_[place->robot][place->link]) {
      pose.reset();
    }
  }
}

void SceneStates::placeRobot(TfLocate& locate, std::size_t robot) {
  const RobotKinematics& kinematics = *joints_->robots()[robot];
  ros::Time stamp;
  for (std::size_t body = 0; body < joints_->bodyCount(); ++body) {
    const auto& place = joints_->placeOf(body);
    if (!place || place->robot != robot || locate.place(body).status != TransformStatus::Ok) continue;
    const ros::Time newest = locate.place(body).stamp;
    if (!newest.isZero() && (stamp.isZero() || newest < stamp)) stamp = newest;
  }
  std::vector<bool>& known = is_known_[robot];
  std::fill(known.begin(), known.end(), true);
  bool is_reported = false;
  for (std::size_t link = 0; link < known.size(); ++link) {
    if (!kinematics.isTaken(link)) continue;
    const FrameTransform found = locate.find(reference_frame_, kinematics.linkNames()[link], stamp);
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
