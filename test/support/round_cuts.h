#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance::test {

/// What a half space cuts off a round solid: integrals over the discs across its axis, each cut by a line,
/// for which there are closed forms. Shares nothing with src/interference.
struct RoundCut {
  double volume = 0.0;
  double area = 0.0;  ///< of the solid's surface
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// Of a disc about the origin what has x <= `to`.
struct DiscCut {
  DiscCut(double radius, double to) {
    const double x = std::clamp(to, -radius, radius);
    const double half = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
    angle = 2.0 * std::atan2(half, -x);
    area = 0.5 * radius * radius * angle + x * half;
    moment = -2.0 / 3.0 * half * half * half;
  }
  double angle;
  double area;
  double moment;
};

/// Calls visit(place, weight) for a double exponential rule (Takahasi and Mori 1974), which bears roots at
/// the ends.
template <typename Visit>
void overInterval(double from, double to, const Visit& visit) {
  constexpr int kPoints = 40;
  constexpr double kStep = 3.2 / kPoints;
  for (int i = -kPoints; i <= kPoints; ++i) {
    const double t = kStep * i;
    const double x = std::tanh(0.5 * kPi * std::sinh(t));
    const double slope = std::cosh(0.5 * kPi * std::sinh(t));
    const double weight = 0.5 * kPi * kStep * std::cosh(t) / (slope * slope);
    visit(0.5 * (from + to + x * (to - from)), 0.5 * (to - from) * weight);
  }
}

/// @param normal unit, shape's frame: what has normal . p <= offset is cut off
inline RoundCut cutOff(const RoundShape& shape, const Eigen::Vector3d& normal, double offset) {
  const double r = shape.radius;
  const double h = shape.half_length;
  const double across = normal.head<2>().norm();
  const bool is_round = shape.kind != RoundKind::Cylinder;
  const double top = is_round ? h + r : h;
  const auto radius_at = [&](double z) {
    const double beyond = std::max(0.0, std::abs(z) - h);
    return std::sqrt(std::max(0.0, (r - beyond) * (r + beyond)));
  };
  const auto disc_at = [&](double z) {
    const double left = offset - normal.z() * z;
    const double to = across > 0.0 ? left / across : (left >= 0.0 ? 1e9 : -1e9);
    return DiscCut(radius_at(z), to);
  };
  std::vector<double> ends{-top, -h, h, top};
  for (const double side : {-r, r}) ends.push_back((offset - across * side) / normal.z());
  for (const double end : {-h, h}) {
    const double away = offset - normal.z() * end;
    const double half = std::sqrt(std::max(0.0, r * r - away * away));
    for (const double way : {-half, half}) ends.push_back(end + away * normal.z() + across * way);
  }
  for (double& end : ends) end = std::isfinite(end) ? std::clamp(end, -top, top) : top;
  std::sort(ends.begin(), ends.end());
  RoundCut cut;
  double outward = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i + 1] - ends[i] <= 1e-14 * top) continue;
    overInterval(ends[i], ends[i + 1], [&](double z, double weight) {
      const DiscCut disc = disc_at(z);
      cut.volume += weight * disc.area;
      cut.area += weight * r * disc.angle;
      cut.moment.z() += weight * z * disc.area;
      outward += weight * disc.moment;
    });
  }
  if (!is_round) cut.area += disc_at(-h).area + disc_at(h).area;
  if (across > 0.0) cut.moment.head<2>() = outward / across * normal.head<2>();
  return cut;
}

}  // namespace concave_distance::test
