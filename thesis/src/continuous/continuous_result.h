#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "continuous_objective.h"

namespace concave_distance {

/// Watches a run, for figures and tables. GA: called after each generation (0 is the initial population).
/// SA: after each iteration (0 is the initial point), the population being the current point.
struct ContinuousRecord {
  std::uint32_t generation;
  const std::vector<ContinuousPoint>* population;
  const ContinuousPoint* best_so_far;
  double boltzmann_factor;  ///< p_b that scales the moves, at most 1
};

using ContinuousObserver = std::function<void(const ContinuousRecord&)>;

/// What a continuous search found.
struct ContinuousResult {
  /// The best point evaluated: of lowest objective, or the best feasible one where the parameters prefer it.
  ContinuousPoint best;
  double distance = 0.0;     ///< between its two points, metres, feasible or not
  bool is_feasible = false;  ///< best.isFeasible(): what a successful run needs (Carretero, sec. 5.1.1)
  std::uint32_t best_generation = 0;  ///< G_i: the generation or iteration in which it appeared
  std::uint32_t generations = 0;      ///< or iterations run, without the initial one
  ContinuousCost cost;
};

}  // namespace concave_distance
