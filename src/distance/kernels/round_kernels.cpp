#include "round_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/surface/round_geometry.h"

namespace concave_distance {
namespace {

using detail::outwardDirection;
using detail::signedDistance;
using Eigen::Vector3d;

constexpr double kMachineEpsilon = std::numeric_limits<double>::epsilon();
// Every third step halves the bracket, so that it always ends.
constexpr int kMostSlopes = 180;
// So that not only the value is right to rounding but its place to a ten-billionth of the shape.
constexpr double kNoGain = 1e-4;

LowestPoint lowerOf(const LowestPoint& l, const LowestPoint& r) {
  return r.value < l.value ? r : l;
}

LowestPoint at(const RoundShape& shape, const Vector3d& point) {
  return {signedDistance(shape, point), point};
}

/// Finds the t in [0, 1] at which the slope of the signed distance along p + t d changes its sign.
class SlopeSearch {
 public:
  SlopeSearch(const RoundShape& shape, const Vector3d& p, const Vector3d& d)
      : shape_(shape), p_(p), d_(d), length_(d.norm()) {}

  LowestPoint find() {
    if (!(length_ > 0.0)) return at(shape_, p_);
    low_slope_ = slope(0.0);
    high_slope_ = slope(1.0);
    if (low_slope_ >= 0.0) return at(shape_, p_);
    if (high_slope_ <= 0.0) return at(shape_, p_ + d_);
    // By how much the least value may be below those at the ends.
    const double enough = kNoGain * kMachineEpsilon * (shape_.radius + shape_.half_length);
    for (int i = 0; i < kMostSlopes && high_ - low_ > 2.0 * kMachineEpsilon * high_; ++i) {
      if (std::min(-low_slope_, high_slope_) * (high_ - low_) <= enough) break;
      double t = i % 3 == 0 ? secant() : i % 3 == 1 ? tangents() : 0.5 * (low_ + high_);
      if (!(t > low_ && t < high_)) t = 0.5 * (low_ + high_);
      const double now = slope(t);
      if (now == 0.0) return at(shape_, p_ + t * d_);
      (now < 0.0 ? low_ : high_) = t;
      (now < 0.0 ? low_slope_ : high_slope_) = now;
    }
    return lowerOf(at(shape_, p_ + low_ * d_), at(shape_, p_ + high_ * d_));
  }

 private:
  double slope(double t) const { return outwardDirection(shape_, p_ + t * d_).dot(d_); }
  double secant() const { return low_ + (high_ - low_) * low_slope_ / (low_slope_ - high_slope_); }

  /// Returns where the tangents at both ends cross: at a kink at once. A little inside, so that its other
  /// side is seen next.
  double tangents() const {
    const double rise = signedDistance(shape_, p_ + high_ * d_) - signedDistance(shape_, p_ + low_ * d_);
    const double t = low_ + (rise - high_slope_ * (high_ - low_)) / (low_slope_ - high_slope_);
    const double inside = 8.0 * kMachineEpsilon;
    return std::clamp(t, low_ + inside, std::max(low_ + inside, high_ - inside));
  }

  const RoundShape& shape_;
  const Vector3d& p_;
  const Vector3d& d_;
  double length_;
  double low_ = 0.0;
  double high_ = 1.0;
  double low_slope_ = 0.0;
  double high_slope_ = 0.0;
};

/// Over the plane, in the plane of symmetry: along the axis as seen on it.
LowestPoint lowestOnPlane(const RoundShape& shape, const Vector3d& normal, double offset) {
  const Vector3d foot = offset * normal;
  if (!detail::hasSide(shape)) return at(shape, foot);
  Vector3d along = Vector3d::UnitZ() - normal.z() * normal;
  const double length = along.norm();
  if (!(length > 16.0 * kMachineEpsilon)) return at(shape, foot);
  along *= detail::reachOf(shape) / length;
  return lowestOnSegment(shape, foot - along, foot + along);
}

/// From the tangent plane at the middle.
double lowerBoundOnSegment(const RoundShape& shape, const Vector3d& p, const Vector3d& q) {
  const Vector3d middle = 0.5 * (p + q);
  return signedDistance(shape, middle) - 0.5 * std::abs(outwardDirection(shape, middle).dot(q - p));
}

bool isInside(const TrianglePoints& triangle, const Vector3d& normal, const Vector3d& point) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = triangle[k];
    const Vector3d& to = triangle[(k + 1) % 3];
    if ((to - from).cross(point - from).dot(normal) < 0.0) return false;
  }
  return true;
}

}  // namespace

LowestPoint lowestOnSegment(const RoundShape& shape, const Vector3d& p, const Vector3d& q) {
  const Vector3d d = q - p;
  if (detail::hasSide(shape)) return SlopeSearch(shape, p, d).find();
  const double squared_length = d.squaredNorm();
  const double t = squared_length > 0.0 ? std::clamp(-p.dot(d) / squared_length, 0.0, 1.0) : 0.0;
  return at(shape, t == 1.0 ? q : Vector3d(p + t * d));
}

LowestPoint lowestOnTriangle(const RoundShape& shape, const TrianglePoints& triangle) {
  Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double area = normal.norm();
  if (area > 0.0) {
    normal /= area;
    // From the corner nearest to the shape, where rounding is least.
    const auto nearest = std::min_element(
        triangle.begin(), triangle.end(),
        [](const Vector3d& l, const Vector3d& r) { return l.squaredNorm() < r.squaredNorm(); });
    LowestPoint face = lowestOnPlane(shape, normal, normal.dot(*nearest));
    if (isInside(triangle, normal, face.point)) return face;
  }
  LowestPoint lowest = lowestOnSegment(shape, triangle[0], triangle[1]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Vector3d& from = triangle[k];
    const Vector3d& to = triangle[(k + 1) % 3];
    if (lowerBoundOnSegment(shape, from, to) < lowest.value)
      lowest = lowerOf(lowest, lowestOnSegment(shape, from, to));
  }
  return lowest;
}

double lowerBoundOnTriangle(const RoundShape& shape, const TrianglePoints& triangle) {
  const Vector3d middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  const Vector3d out = outwardDirection(shape, middle);
  double least = 0.0;
  for (const Vector3d& corner : triangle) least = std::min(least, out.dot(corner - middle));
  return signedDistance(shape, middle) + least;
}

}  // namespace concave_distance
