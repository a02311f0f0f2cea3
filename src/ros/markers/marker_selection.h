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

/// A pair that could be drawn.
struct MarkedPair {
  const PairNiches* pair = nullptr;
  bool knows_niches = false;  ///< false: its niches were not asked for
};

/// The pairs that the markers show, and those whose niches they need for it.
struct MarkerSelection {
  std::vector<DrawnPair> drawn;           ///< ascending by distance
  std::vector<const PairNiches*> wanted;  ///< pairs whose niches are needed, also of those drawn
  std::size_t candidates = 0;             ///< pairs that are drawn, or would be if there were fewer
};

/// Selects the style.pair_count nearest pairs and every pair in warning. Of each, the nearest niche is drawn;
/// other niches of these pairs follow, nearest first, up to style.niche_count in all. A pair whose niches are
/// not known is wanted, and drawn when they are.
MarkerSelection selectPairs(const std::vector<MarkedPair>& pairs, const MarkerStyle& style);

}  // namespace concave_distance
