#include "round_lines.h"

#include <cmath>
#include <limits>

#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

constexpr int kMostSteps = 100;

}  // namespace

double wayOut(const RoundShape& shape, const Vector3d& from, const Vector3d& direction, double farthest) {
  const auto value = [&](double way) { return signedDistance(shape, from + way * direction); };
  double low = 0.0;
  double low_value = value(0.0);
  double high = farthest;
  double high_value = value(high);
  if (high_value <= 0.0) return high;
  if (low_value >= 0.0) return 0.0;
  // Regula falsi with the Illinois weights, whose end moves from both sides.
  int side = 0;
  const double enough = 4.0 * std::numeric_limits<double>::epsilon() * farthest;
  for (int i = 0; i < kMostSteps && high - low > enough; ++i) {
    double middle = low - low_value * (high - low) / (high_value - low_value);
    if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
    const double now = value(middle);
    if (std::abs(now) <= 0.25 * enough) return middle;
    if (now < 0.0) {
      low = middle;
      low_value = now;
      if (side < 0) high_value *= 0.5;
      side = -1;
    } else {
      high = middle;
      high_value = now;
      if (side > 0) low_value *= 0.5;
      side = 1;
    }
  }
  return low;
}

LineCuts kinksOf(const RoundShape& shape, const Vector3d& from, const Vector3d& to) {
  LineCuts kinks;
  if (shape.kind == RoundKind::Sphere) return kinks;
  const Vector3d d = to - from;
  const double h = shape.half_length;
  if (shape.kind == RoundKind::Capsule) {
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
