#pragma once

#include <algorithm>
#include <array>

#include "distance/kernels/facet_points.h"

namespace concave_distance::detail {

/// Squared distances between two facets and between the edges of each and the other one, m^2. Edge k goes
/// from corner k to the next.
struct FacetPairLevels {
  std::array<double, 4> edges_of_a;  ///< a triangle's fourth is not below its first
  std::array<double, 4> edges_of_b;
  double least() const {
    return std::min(*std::min_element(edges_of_a.begin(), edges_of_a.end()),
                    *std::min_element(edges_of_b.begin(), edges_of_b.end()));
  }
};

/// All of them at once, each with the error of triangleDistance() and what the quadrangles are not flat: two
/// flat convex facets that do not cross are closest on an edge of one of them.
FacetPairLevels facetPairLevels(const FacetPoints& a, const FacetPoints& b);

}  // namespace concave_distance::detail
