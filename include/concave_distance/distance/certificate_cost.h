#pragma once

#include <cstdint>

namespace concave_distance {

/// What a proof cost.
struct CertificateCost {
  std::uint32_t box_bounds = 0;      ///< pairs of boxes bounded
  std::uint32_t leaf_pairs = 0;      ///< pairs of up to four triangles each looked at
  std::uint32_t triangle_pairs = 0;  ///< distances of triangles computed
};

}  // namespace concave_distance
