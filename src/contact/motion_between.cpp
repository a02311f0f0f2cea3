#include "motion_between.h"

namespace concave_distance {

RelativeTwist motionBetween(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after, double seconds) {
  RelativeTwist b_in_a;
  if (!(seconds > 0.0)) return b_in_a;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(after.linear() * before.linear().transpose()));
  b_in_a.angular = turn.angle() / seconds * turn.axis();
  const Eigen::Vector3d middle = 0.5 * (before.translation() + after.translation());
  b_in_a.linear = (after.translation() - before.translation()) / seconds - b_in_a.angular.cross(middle);
  return b_in_a;
}

}  // namespace concave_distance
