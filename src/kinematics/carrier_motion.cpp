#include "carrier_motion.h"

#include <unordered_map>

#include "contact/motion_between.h"

namespace concave_distance::detail {

void CarrierMotion::reset() {
  roots_.clear();
  bodies_.clear();
  time_.reset();
}

void CarrierMotion::setScene(const SceneKinematics& before, const SceneKinematics& now) {
  std::unordered_map<const RobotKinematics*, Carrier> roots;
  for (std::size_t i = 0; i < roots_.size(); ++i) roots[before.robots()[i].get()] = roots_[i];
  std::unordered_map<std::uint64_t, Carrier> bodies;
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies[before.serialOf(i)] = bodies_[i];
  roots_.clear();
  for (const auto& robot : now.robots()) roots_.push_back(roots[robot.get()]);
  bodies_.clear();
  for (std::size_t i = 0; i < now.bodyCount(); ++i) bodies_.push_back(bodies[now.serialOf(i)]);
}

void CarrierMotion::Carrier::move(const std::optional<Eigen::Isometry3d>& now, double seconds) {
  twist.reset();
  if (pose && now && seconds > 0.0) twist = motionBetween(*pose, *now, seconds);
  pose = now;
}

void CarrierMotion::update(const SceneKinematics& joints, const SceneState& state, double time) {
  const double seconds = time_ ? time - *time_ : 0.0;
  time_ = time;
  roots_.resize(joints.robots().size());
  bodies_.resize(joints.bodyCount());
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    roots_[i].move(state.robots[i].world_from_link.front(), seconds);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!joints.placeOf(i)) bodies_[i].move(state.world_from_body[i], seconds);
  }
}

const std::optional<RelativeTwist>& CarrierMotion::of(const SceneKinematics& joints, std::size_t body) const {
  const auto& place = joints.placeOf(body);
  return place ? roots_[place->robot].twist : bodies_[body].twist;
}

}  // namespace concave_distance::detail
