#pragma once

#include <cstdint>

namespace concave_distance {

/// How niches and contacts are drawn. Lengths in metres.
struct MarkerStyle {
  double scale = 0.0;              ///< diameter of the nearest points; 0: from the scene's size
  double near = 0.0;               ///< distance drawn in the near colour
  double far = 0.0;                ///< distance drawn in the far colour, and beyond; 0: from the scene's size
  double force_scale = 1000.0;     ///< newtons that an arrow of one metre represents
  double pressure_scale = 0.0;     ///< Pa, in the last colour; 0: from the largest pressure
  std::uint32_t pair_count = 5;    ///< nearest pairs drawn, beside those in warning; 0: every pair
  std::uint32_t niche_count = 12;  ///< niches drawn of all pairs together, and contacts labelled; 0: all
};

}  // namespace concave_distance
