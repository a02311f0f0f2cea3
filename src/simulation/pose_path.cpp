#include "pose_path.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace concave_distance {
namespace {

Eigen::AngleAxisd turnBetween(const TimedPose& from, const TimedPose& to) {
  Eigen::Quaterniond turn(to.pose.linear() * from.pose.linear().transpose());
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  return Eigen::AngleAxisd(turn);
}

}  // namespace

PosePath::PosePath(std::vector<TimedPose> poses) : poses_(std::move(poses)) {}

std::size_t PosePath::pieceOf(double time) const {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), time,
                                      [](double t, const TimedPose& pose) { return t < pose.time; });
  return after == poses_.begin() ? poses_.size() : static_cast<std::size_t>(after - poses_.begin()) - 1;
}

Eigen::Isometry3d PosePath::poseAt(double time) const {
  const std::size_t piece = pieceOf(time);
  if (piece == poses_.size()) return poses_.front().pose;
  if (piece + 1 == poses_.size()) return poses_.back().pose;
  const TimedPose& from = poses_[piece];
  const TimedPose& to = poses_[piece + 1];
  const double share = (time - from.time) / (to.time - from.time);
  const Eigen::AngleAxisd turn = turnBetween(from, to);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix() * from.pose.linear();
  pose.translation() = (1.0 - share) * from.pose.translation() + share * to.pose.translation();
  return pose;
}

FrameTwist PosePath::twistAt(double inside) const {
  const std::size_t piece = pieceOf(inside);
  if (piece == poses_.size() || piece + 1 == poses_.size()) return {};
  const TimedPose& from = poses_[piece];
  const TimedPose& to = poses_[piece + 1];
  const double span = to.time - from.time;
  const Eigen::AngleAxisd turn = turnBetween(from, to);
  return {(to.pose.translation() - from.pose.translation()) / span, turn.angle() / span * turn.axis()};
}

double PosePath::nextChange(double time) const {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), time,
                                      [](double t, const TimedPose& pose) { return t < pose.time; });
  return after == poses_.end() ? std::numeric_limits<double>::infinity() : after->time;
}

}  // namespace concave_distance
