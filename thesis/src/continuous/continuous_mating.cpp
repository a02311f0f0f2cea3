#include "continuous_mating.h"

namespace concave_distance {
namespace {

PointPair between(const PointPair& from, const PointPair& to, double share_a, double share_b) {
  return {from.point_a + share_a * (to.point_a - from.point_a),
          from.point_b + share_b * (to.point_b - from.point_b)};
}

}  // namespace

std::pair<PointPair, PointPair> mateContinuous(ContinuousMating mating, const ContinuousPoint& parent_1,
                                               const ContinuousPoint& parent_2, RandomEngine& engine) {
  const PointPair first{parent_1.point_a, parent_1.point_b};
  const PointPair second{parent_2.point_a, parent_2.point_b};
  if (mating == ContinuousMating::LinearScaling) {
    double shares[4];
    for (double& share : shares) {
      share = uniformUnit(engine);
    }
    return {between(first, second, shares[0], shares[1]), between(first, second, shares[2], shares[3])};
  }
  const double sum = parent_1.objective + parent_2.objective;
  const double share = sum > 0.0 ? parent_1.objective / sum : 0.5;
  const PointPair child = between(first, second, share, share);
  if (mating == ContinuousMating::FitnessWeightedTwice) return {child, child};
  const double share_on = uniformUnit(engine);
  const PointPair& better = parent_1.objective <= parent_2.objective ? first : second;
  return {child, between(child, better, share_on, share_on)};
}

}  // namespace concave_distance
