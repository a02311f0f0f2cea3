#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"

/// Every local minimum of the distance between two surfaces by brute force: all triangle pairs, in long
/// double, and 0-dimensional persistence over all of them. Shares no code with findLocalMinima.
namespace concave_distance::test {

struct BruteForceMinimum {
  double distance;
  double prominence;  ///< infinite for the deepest
  std::uint32_t triangle_a;
  std::uint32_t triangle_b;
  /// Of the set of its minimisers on A, metres: the largest distance of two of them, and how far one is off
  /// the line through those.
  double length;
  double width;
};

/// Minima up to `cutoff` of at least that prominence, ascending by distance. Passes up to (1 +
/// least_prominence) times the cutoff are known, higher ones are infinite. Minima whose pass is not higher
/// than they are by `rounding`, metres, are one, and so are places where the bodies meet in one part of their
/// overlap; `plateau`, metres, is what the sets of minimisers may rise.
/// Prominences are those of distances and passes less `margin`, metres: minima within it that a path within
/// it joins are one, and those that stay have an infinite prominence. O(pairs) time and memory.
std::vector<BruteForceMinimum> bruteForceMinima(const BodyMesh& a, const BodyMesh& b,
                                                const Eigen::Isometry3d& a_from_b, double cutoff,
                                                double least_prominence, double rounding, double plateau,
                                                double margin = 0.0);

}  // namespace concave_distance::test
