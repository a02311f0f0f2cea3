#pragma once

#include <algorithm>
#include <limits>

namespace concave_distance {

/// The rule that says which local minima are niches: every path from a niche to a place at least as near
/// rises to the niche's distance times (1 + least prominence). All of distance/niches asks it here. Another
/// rule has to answer distance 0, where places that touch stay apart, and far bodies
/// (allowsOneNicheOnly()), by which the cost does not grow with the distance.
struct NicheRule {
  double least_prominence = 1e-2;  ///< minima with less are part of the nearer niche that they lead to
  /// Prominences are measured up to this; up to `least_prominence` none is.
  double prominence_limit = 0.0;

  bool measuresProminences() const { return prominence_limit > least_prominence; }

  /// The level (metres) below which no path from a niche at this distance leads to a place as near.
  double levelOf(double distance) const { return (1.0 + least_prominence) * distance; }

  /// The level (metres) up to which passes are looked for; what lies beyond the cutoff is not asked for.
  double measuredLevelOf(double distance, double cutoff) const {
    return std::max(levelOf(distance), std::min((1.0 + prominence_limit) * distance, cutoff));
  }

  /// Returns the prominence, a ratio, of a minimum at `distance` (metres) whose lowest path to a place as
  /// near rises to `pass` (metres).
  static double prominenceOf(double distance, double pass) {
    return distance > 0.0 ? pass / distance - 1.0 : std::numeric_limits<double>::infinity();
  }

  /// True when distances between `nearest` and `farthest` (metres) leave no room for a pass as high as a
  /// niche needs.
  bool allowsOneNicheOnly(double nearest, double farthest) const {
    return nearest > 0.0 && farthest < levelOf(nearest);
  }
};

}  // namespace concave_distance
