#pragma once

#include <algorithm>
#include <limits>

namespace concave_distance {

/// The rule that says which local minima are niches: every path from a niche to a place at least as near
/// rises to the niche's distance times (1 + least prominence). Both distances are padded: of the surfaces
/// moved out by the bodies' margins. All of distance/niches asks it here, with the distances of the bare
/// surfaces. Places at or below the margin are at the padded distance 0: one niche where they are connected.
/// Another rule has to answer distance 0, where places that touch stay apart, and far bodies
/// (allowsOneNicheOnly()), by which the cost does not grow with the distance.
struct NicheRule {
  double least_prominence = 1e-2;  ///< minima with less are part of the nearer niche that they lead to
  /// Prominences are measured up to this; up to `least_prominence` none is.
  double prominence_limit = 0.0;
  double margin = 0.0;  ///< metres, of both bodies together

  bool measuresProminences() const { return prominence_limit > least_prominence; }

  /// The level (metres) below which no path from a niche at this distance leads to a place as near.
  double levelOf(double distance) const { return margin + (1.0 + least_prominence) * padded(distance); }

  /// How far the level is above the distance, metres.
  double riseAt(double distance) const {
    return distance > margin ? least_prominence * (distance - margin) : margin - distance;
  }

  /// The least riseAt() any distance from `distance` on, metres.
  double leastRiseFrom(double distance) const { return least_prominence * padded(distance); }

  /// The level (metres) up to which passes are looked for; what lies beyond the cutoff is not asked for.
  double measuredLevelOf(double distance, double cutoff) const {
    const double limit = isAtZero(distance) ? margin : margin + (1.0 + prominence_limit) * padded(distance);
    return std::max(levelOf(distance), std::min(limit, cutoff));
  }

  /// Returns the prominence, a ratio, of a minimum at `distance` (metres) whose lowest path to a place as
  /// near rises to `pass` (metres).
  double prominenceOf(double distance, double pass) const {
    return isAtZero(distance) ? std::numeric_limits<double>::infinity()
                              : (pass - margin) / (distance - margin) - 1.0;
  }

  /// Returns whether the padded distance is 0.
  bool isAtZero(double distance) const { return distance <= margin; }

  /// True when distances between `nearest` and `farthest` (metres) leave no room for a pass as high as a
  /// niche needs.
  bool allowsOneNicheOnly(double nearest, double farthest) const {
    return nearest > margin && farthest < levelOf(nearest);
  }

 private:
  double padded(double distance) const { return std::max(0.0, distance - margin); }
};

}  // namespace concave_distance
