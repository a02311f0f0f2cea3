#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance::detail {

/// Returns how far from `from`, inside the solid, the solid ends along a unit direction, metres; at most
/// `farthest`. The point there is a few machine epsilons of the solid's size from its surface.
double wayOut(const RoundShape& shape, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
              double farthest);

/// Shares of a line's length at which an integral along it is cut.
struct LineCuts {
  std::array<double, 24> shares{};
  std::size_t count = 0;

  void add(double share) {
    if (share > 0.0 && share < 1.0 && count < shares.size()) shares[count++] = share;
  }
  /// Ascending, those that are not there are 1.
  const std::array<double, 24>& sorted() {
    std::fill(shares.begin() + static_cast<std::ptrdiff_t>(count), shares.end(), 1.0);
    std::sort(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count));
    return shares;
  }
  /// Adds the roots of a x^2 + b x + c.
  void addRoots(double a, double b, double c) {
    const double root = b * b - 4.0 * a * c;
    if (root < 0.0) return;
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    if (a != 0.0) add(q / a);
    if (q != 0.0) add(c / q);
  }
};

/// Returns where a line changes from one piece of the depth below a solid's surface to another.
LineCuts kinksOf(const RoundShape& shape, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace concave_distance::detail
