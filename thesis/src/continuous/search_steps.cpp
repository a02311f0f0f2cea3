#include "search_steps.h"

#include <cmath>

#include "local_step.h"

namespace concave_distance {

ContinuousPoint startingPoint(const ContinuousObjective& objective, InitialPoints method,
                              RandomEngine& engine, ContinuousCost& cost) {
  constexpr std::uint32_t kProjections = 8;
  PointPair start = randomPair(objective.a().boundingBox(), objective.b().boundingBox(), engine);
  if (method == InitialPoints::Projected) {
    start.point_a = projectOntoBody(objective.a(), start.point_a, kProjections, cost);
    start.point_b = projectOntoBody(objective.b(), start.point_b, kProjections, cost);
  }
  return objective.evaluate(start.point_a, start.point_b, cost);
}

bool BestPoint::isBetter(const ContinuousPoint& x) const {
  if (prefer_feasible_ && x.isFeasible() != point_.isFeasible()) {
    return x.isFeasible();
  }
  return x.objective < point_.objective;
}

void BestPoint::offer(const ContinuousPoint& x, std::uint32_t generation) {
  if (is_empty_ || isBetter(x)) {
    is_empty_ = false;
    point_ = x;
    generation_ = generation;
  }
}

ContinuousResult finishedRun(const ContinuousObjective& objective, const LocalStepParameters& local_step,
                             std::uint32_t final_repeats, BestPoint& best, std::uint32_t generations,
                             const ContinuousCost& cost) {
  ContinuousResult result;
  result.cost = cost;
  LocalStepParameters one_step = local_step;
  one_step.repeats = 1;
  ContinuousPoint x = best.point();
  for (std::uint32_t i = 0; i < final_repeats; ++i) {
    improveLocally(objective, one_step, x, result.cost);
    best.offer(x, best.generation());
  }
  result.best = best.point();
  result.distance = std::sqrt(result.best.squared_distance);
  result.is_feasible = result.best.isFeasible();
  result.best_generation = best.generation();
  result.generations = generations;
  return result;
}

}  // namespace concave_distance
