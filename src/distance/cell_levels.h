#pragma once

#include <algorithm>
#include <array>

#include "triangle_distance.h"

namespace concave_distance::detail {

/// Squared distances between two triangles and between the edges of each and the other triangle, m^2. Edge k
/// goes from corner k to the next.
struct CellLevels {
  std::array<double, 3> edges_of_a;
  std::array<double, 3> edges_of_b;
  double least() const {
    return std::min(
        {edges_of_a[0], edges_of_a[1], edges_of_a[2], edges_of_b[0], edges_of_b[1], edges_of_b[2]});
  }
};

/// All of them at once, each with the error of triangleDistance(): two triangles that do not cross are
/// closest on an edge of one of them.
CellLevels cellLevels(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace concave_distance::detail
