#pragma once

#include <cstdint>
#include <limits>

#include "base/random_engine.h"
#include "continuous_objective.h"
#include "continuous_parameters.h"
#include "continuous_result.h"
#include "random_moves.h"

namespace concave_distance {

/// What cont-GA and cont-SA have in common: starting points and the best point met.

/// A random trial point, evaluated.
ContinuousPoint startingPoint(const ContinuousObjective& objective, InitialPoints method,
                              RandomEngine& engine, ContinuousCost& cost);

/// Keeps the best point seen and when it came.
class BestPoint {
 public:
  explicit BestPoint(bool prefer_feasible) : prefer_feasible_(prefer_feasible) {}
  void offer(const ContinuousPoint& x, std::uint32_t generation);
  const ContinuousPoint& point() const { return point_; }
  std::uint32_t generation() const { return generation_; }

 private:
  bool isBetter(const ContinuousPoint& x) const;

  bool prefer_feasible_;
  bool is_empty_ = true;
  ContinuousPoint point_;
  std::uint32_t generation_ = 0;
};

/// The result of a run that has ended: its best, after final_repeats local steps.
ContinuousResult finishedRun(const ContinuousObjective& objective, const LocalStepParameters& local_step,
                             std::uint32_t final_repeats, BestPoint& best, std::uint32_t generations,
                             const ContinuousCost& cost);

}  // namespace concave_distance
