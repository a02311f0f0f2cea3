#pragma once

#include <concave_distance/PairNiches.h>

#include <cstddef>
#include <vector>

#include "concave_distance/ros/marker_style.h"

namespace concave_distance {

/// A pair that is drawn.
struct DrawnPair {
  const PairNiches* pair = nullptr;
  std::size_t niche_count = 0;  ///< how many of its niches, from the nearest on
};

/// Whether there is something to draw: a niche, or the closest points of a body inside another.
bool hasMarkers(const PairNiches& pair);

/// The style.pair_count nearest pairs and every pair in warning, ascending by distance. The nearest niche of
/// each is drawn; the others of these pairs, nearest first, until style.niche_count are drawn in all.
std::vector<DrawnPair> selectPairs(const std::vector<PairNiches>& pairs, const MarkerStyle& style);

}  // namespace concave_distance
