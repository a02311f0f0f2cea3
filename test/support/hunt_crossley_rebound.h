#pragma once

#include <algorithm>
#include <cmath>

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

}  // namespace concave_distance::test
