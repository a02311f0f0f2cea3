#pragma once

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace concave_distance::test {

/// Speed, m/s, with which a body that meets Hunt and Crossley's spring at `speed` leaves it, without weight:
/// m v dv/dx = -k x^1.5 (1 + s v) with s = 1.5 c separates, so that v/s - ln(1 + s v)/s^2 is equal at impact
/// (v) and at the end (-e v): bisection for e v. @param dissipation c, s/m, > 0
inline double huntCrossleyRebound(double speed, double dissipation) {
  const double s = 1.5 * dissipation;
  const auto potential = [s](double v) { return v / s - std::log1p(s * v) / (s * s); };
  double low = 0.0;
  double high = std::min(speed, (1.0 - 1e-15) / s);
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (potential(-middle) < potential(speed) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A ball that meets a plane with a pressure s d (1 + s_v v cos) over both surfaces of the overlap, d the
/// depth, v cos the speed along the surface's normal, s that of Hertz's paraboloid of the same integrals.
struct PressedBall {
  double radius;   ///< metres
  double mass;     ///< kg
  double modulus;  ///< E*, Pa
};

/// Force at a depth, N, and what it grows by with the rate, N: integrals over u = cos on the ball's cap, over
/// the distance q to the ball's centre on the plane's disc.
inline void pressOnPlane(const PressedBall& ball, double depth, double& elastic, double& damped) {
  const double r = ball.radius;
  const double h = r - depth;
  const double c = h / r;
  const auto disc = [&](double q) { return q * q * (r / 2.0 - q / 3.0); };
  const auto disc_squares = [&](double q) { return q * q * (r * r / 2.0 - 2.0 / 3.0 * r * q + q * q / 4.0); };
  const double on_disc = 2.0 * kPi * (disc(r) - disc(h));
  const double volume = 0.5 * (kPi * r * depth * depth + on_disc);
  const double moment =
      0.25 * (2.0 / 3.0 * kPi * r * depth * depth * depth + 2.0 * kPi * (disc_squares(r) - disc_squares(h)));
  const double hertz_depth = 3.0 * moment / volume;
  const double hertz_radius = volume / (kPi * hertz_depth * hertz_depth);
  const double stiffness =
      4.0 / 3.0 * ball.modulus * std::sqrt(hertz_radius * hertz_depth) * hertz_depth / volume;
  const double cap = 2.0 * kPi * r * r * (r / 3.0 * (1.0 - c * c * c) - h / 2.0 * (1.0 - c * c));
  const double cap_damped =
      2.0 * kPi * r * r * (r / 4.0 * (1.0 - c * c * c * c) - h / 3.0 * (1.0 - c * c * c));
  elastic = 0.5 * stiffness * (cap + on_disc);
  damped = 0.5 * stiffness * (cap_damped + on_disc);
}

/// Speed with which it leaves, without weight: midpoint rule.
inline double pressureRebound(const PressedBall& ball, double speed, double dissipation) {
  const double s = 1.5 * dissipation;
  const double step = 2e-5 * ball.radius / speed;
  const auto acceleration = [&](double depth, double rate) {
    if (!(depth > 0.0)) return 0.0;
    double elastic = 0.0;
    double damped = 0.0;
    pressOnPlane(ball, depth, elastic, damped);
    return -std::max(0.0, elastic + s * rate * damped) / ball.mass;
  };
  double depth = 1e-9 * ball.radius;
  double rate = speed;
  while (depth > 0.0) {
    const double middle = rate + 0.5 * step * acceleration(depth, rate);
    rate += step * acceleration(depth + 0.5 * step * rate, middle);
    depth += step * middle;
  }
  return -rate;
}

}  // namespace concave_distance::test
