#include "round_lines.h"

#include <limits>

#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// The way from a place inside a ball, or a circle, or towards it, to where it ends: the larger root of
/// squared_speed t^2 + 2 along t + (place^2 - radius^2), without cancellation.
double wayToBorder(double squared_speed, double along, double squared_place, double radius) {
  const double left = radius * radius - squared_place;
  const double root = std::sqrt(std::max(0.0, along * along + squared_speed * left));
  return along > 0.0 ? std::max(0.0, left) / (along + root) : (root - along) / squared_speed;
}

double wayOutOfBall(const Vector3d& from, const Vector3d& direction, double radius) {
  return wayToBorder(1.0, from.dot(direction), from.squaredNorm(), radius);
}

/// Out of the round side, infinite along the axis.
double wayOutOfSide(const RoundShape& shape, const Vector3d& from, const Vector3d& direction) {
  const Eigen::Vector2d across = direction.head<2>();
  const double squared_speed = across.squaredNorm();
  if (!(squared_speed > 0.0)) return std::numeric_limits<double>::infinity();
  return wayToBorder(squared_speed, from.head<2>().dot(across), from.head<2>().squaredNorm(), shape.radius);
}

double wayOutOfSolid(const RoundShape& shape, const Vector3d& from, const Vector3d& direction) {
  if (!hasSide(shape)) return wayOutOfBall(from, direction, shape.radius);
  const double side = wayOutOfSide(shape, from, direction);
  if (hasFlatEnds(shape)) {
    if (direction.z() == 0.0) return side;
    const double cap = std::copysign(shape.half_length, direction.z());
    return std::min(side, (cap - from.z()) / direction.z());
  }
  const double level = direction.z() == 0.0 ? from.z() : from.z() + side * direction.z();
  if (std::abs(level) <= shape.half_length) return side;
  const double end = std::copysign(shape.half_length, level);
  return wayOutOfBall(from - end * Vector3d::UnitZ(), direction, shape.radius);
}

}  // namespace

double wayOut(const RoundShape& shape, const Vector3d& from, const Vector3d& direction, double farthest) {
  if (signedDistance(shape, from) >= 0.0) return 0.0;
  return std::clamp(wayOutOfSolid(shape, from, direction), 0.0, farthest);
}

LineCuts kinksOf(const RoundShape& shape, const Vector3d& from, const Vector3d& to) {
  LineCuts kinks;
  if (!hasSide(shape)) return kinks;
  const Vector3d d = to - from;
  const double h = shape.half_length;
  if (!hasFlatEnds(shape)) {
    for (const double end : {-h, h}) kinks.add((end - from.z()) / d.z());
  } else {
    // As far below the cap as below the side: rho = r - h + |z|.
    kinks.add(-from.z() / d.z());
    for (const double side : {-1.0, 1.0}) {
      const double level = shape.radius - h + side * from.z();
      kinks.addRoots(d.head<2>().squaredNorm() - d.z() * d.z(),
                     2.0 * (from.head<2>().dot(d.head<2>()) - level * side * d.z()),
                     from.head<2>().squaredNorm() - level * level);
    }
  }
  return kinks;
}

}  // namespace concave_distance::detail
