#pragma once

#include <concave_distance/PairNiches.h>

#include <cstddef>
#include <set>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_style.h"

namespace concave_distance {

/// A pair that is drawn.
struct DrawnPair {
  const PairNiches* pair = nullptr;
  std::size_t niche_count = 0;  ///< number of its nearest niches; 0: they are not known
  bool is_nearest = false;      ///< of all pairs
};

/// Whether the message has a distance with its points, so that there is a line to draw.
bool hasMarkers(const PairNiches& pair);

/// Selects the style.pair_count nearest pairs and every pair in warning, ascending by distance. Of each, the
/// nearest niche is drawn or, while its niches are not known, its shortest distance; other niches of these
/// pairs follow, nearest first, up to style.niche_count in all.
std::vector<DrawnPair> selectPairs(const std::vector<const PairNiches*>& pairs, const MarkerStyle& style);

/// The bodies to tint, as indices into scene.bodies: of a warning, what is warned of and the nearest link of
/// the robot; of two links or two obstacles, both.
/// @param drawn ascending by distance
/// @param largest diameter of a body (m): a red floor would hide the rest
std::set<std::size_t> warnedBodies(const Scene& scene, const std::vector<DrawnPair>& drawn, double largest);

}  // namespace concave_distance
