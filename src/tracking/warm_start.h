#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// Collects what the next population inherits from the niches of the last cycle.
struct Inheritance {
  double per_niche = 3.0;    ///< alpha_Gamma
  std::uint32_t limit = 30;  ///< N_popGamma_max
  /// Each niche gets one copy before any gets a second, where the total allows: a share rounded to nothing
  /// would forget the niche. The thesis does not (6.7).
  bool one_each = true;
};

/// N_popGamma = min(alpha_Gamma N_Gamma, N_popGamma_max) copies (Carretero, eq. (6.8)), shared among the
/// niches in proportion to phi = 1 / (d^2 + eps^2) (6.7) by largest remainders, so that the copies sum up
/// exactly.
/// @param epsilon fitnessEpsilon() of the search that inherits
void inherit(const std::vector<TrialPoint>& niches, const Inheritance& inheritance, double epsilon,
             std::vector<TrialPoint>& population, std::vector<double>& scratch);

}  // namespace concave_distance
