#include "random_moves.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

Eigen::Vector3d pointIn(const Eigen::AlignedBox3d& box, RandomEngine& engine) {
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = box.min()[axis] + uniformUnit(engine) * (box.max()[axis] - box.min()[axis]);
  }
  return point;
}

/// (2.12), which is (2.7) for scale 1.
double movedCoordinate(double old, double low, double high, double scale, RandomEngine& engine) {
  return old + scale * (uniformUnit(engine) * (high - low) - (old - low));
}

/// (2.9)-(2.11), (2.13).
Eigen::Vector3d displaced(const Eigen::Vector3d& point, const Eigen::AlignedBox3d& box, double scale,
                          RandomEngine& engine) {
  Eigen::Vector3d direction;
  do {
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = 2.0 * uniformUnit(engine) - 1.0;
    }
  } while (direction.squaredNorm() == 0.0);
  const double size_factor = 0.5 * box.diagonal().norm();
  return point + scale * uniformUnit(engine) * size_factor * direction.normalized();
}

}  // namespace

PointPair randomPair(const Eigen::AlignedBox3d& box_a, const Eigen::AlignedBox3d& box_b,
                     RandomEngine& engine) {
  const Eigen::Vector3d point_a = pointIn(box_a, engine);
  const Eigen::Vector3d point_b = pointIn(box_b, engine);
  return {point_a, point_b};
}

PointPair moveRandomly(RandomMove move, const PointPair& x, const Eigen::AlignedBox3d& box_a,
                       const Eigen::AlignedBox3d& box_b, double scale, RandomEngine& engine) {
  PointPair moved = x;
  switch (move) {
    case RandomMove::Cartesian: {
      const std::uint32_t entry = uniformIndex(engine, 6);
      const Eigen::AlignedBox3d& box = entry < 3 ? box_a : box_b;
      double& coordinate = entry < 3 ? moved.point_a[entry] : moved.point_b[entry - 3];
      coordinate = movedCoordinate(coordinate, box.min()[entry % 3], box.max()[entry % 3], scale, engine);
      break;
    }
    case RandomMove::RandomDirection:
      moved.point_a = displaced(x.point_a, box_a, scale, engine);
      moved.point_b = displaced(x.point_b, box_b, scale, engine);
      break;
  }
  return moved;
}

double boltzmannFactor(double f_before, double f_now, double boltzmann_constant, double temperature) {
  if (f_now <= f_before) {
    return 1.0;
  }
  const double scale = boltzmann_constant * temperature;
  return scale > 0.0 ? std::min(1.0, std::exp((f_before - f_now) / scale)) : 0.0;
}

}  // namespace concave_distance
