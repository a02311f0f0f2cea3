#pragma once

#include <concave_distance/PairNiches.h>

#include <cstddef>
#include <vector>

#include "marker_style.h"

namespace concave_distance {

/// A pair that is drawn.
struct DrawnPair {
  const PairNiches* pair = nullptr;
  std::size_t niche_count = 0;  ///< number of its nearest niches
};

/// Whether there is something to draw: a niche, or the closest points of a body inside another.
bool hasMarkers(const PairNiches& pair);

/// The style.pair_count nearest pairs and every pair in warning, ascending by distance. Of each, the nearest
/// niche is drawn; other niches of these pairs follow, nearest first, up to style.niche_count in all.
std::vector<DrawnPair> selectPairs(const std::vector<PairNiches>& pairs, const MarkerStyle& style);

}  // namespace concave_distance
