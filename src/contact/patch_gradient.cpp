#include "patch_gradient.h"

#include <algorithm>

namespace concave_distance {
namespace {

// The decrease is at most this share of the largest that leaves the stiffness positive.
constexpr double kLargestDecrease = 0.9;

}  // namespace

void PatchGradient::add(const OverlapSample& sample) {
  const Vector6d out = sample.area * wrenchRow(sample.exit_in_a, sample.point_in_a);
  push += sample.area * sample.depth * wrenchRow(sample.push_in_a, sample.point_in_a);
  volume += out;
  moment += sample.depth * out;
}

void addChangeOfLaw(const PressureLaw& law, const PatchGradient& gradient, double moment,
                    Matrix6d& stiffness) {
  const double squared_push = gradient.push.head<3>().squaredNorm();
  if (!(squared_push > 0.0 && moment > 0.0)) return;
  const Vector6d change =
      law.by_volume * gradient.volume + law.by_moment * gradient.moment + law.by_depth * gradient.depth;
  const double along = std::max(change.head<3>().dot(gradient.push.head<3>()) / squared_push,
                                -0.5 * kLargestDecrease / moment);
  stiffness.triangularView<Eigen::Upper>() +=
      law.stiffness * along * gradient.push * gradient.push.transpose();
}

}  // namespace concave_distance
