#pragma once

#include <Eigen/Core>
#include <array>

#include "triangle_distance.h"

namespace concave_distance::detail {

/// The corners of a facet (mesh/surface/facets.h).
struct FacetPoints {
  std::array<Eigen::Vector3d, 4> corners;  ///< the fourth of a triangle is its first again
  bool is_quad = false;

  std::size_t edgeCount() const { return is_quad ? 4 : 3; }
  TrianglePoints first() const { return {corners[0], corners[1], corners[2]}; }
  TrianglePoints second() const { return {corners[0], corners[2], corners[3]}; }
};

struct FacetPairDistance {
  TrianglePairDistance closest;
  bool is_in_second_of_a = false;
  bool is_in_second_of_b = false;
};

/// Error: that of triangleDistance().
inline FacetPairDistance facetDistance(const FacetPoints& a, const FacetPoints& b) {
  FacetPairDistance found{triangleDistance(a.first(), b.first())};
  const auto look = [&](const TrianglePoints& of_a, const TrianglePoints& of_b, bool second_a,
                        bool second_b) {
    const TrianglePairDistance other = triangleDistance(of_a, of_b);
    if (other.squared_distance < found.closest.squared_distance) found = {other, second_a, second_b};
  };
  if (a.is_quad) look(a.second(), b.first(), true, false);
  if (b.is_quad) look(a.first(), b.second(), false, true);
  if (a.is_quad && b.is_quad) look(a.second(), b.second(), true, true);
  return found;
}

}  // namespace concave_distance::detail
