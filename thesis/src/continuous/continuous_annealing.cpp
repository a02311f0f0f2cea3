#include "continuous_annealing.h"

#include "local_step.h"
#include "search_steps.h"

namespace concave_distance {

ContinuousResult continuousAnnealing(const ConstraintTree& a, const ConstraintTree& b,
                                     const Eigen::Isometry3d& a_from_b,
                                     const ContinuousAnnealingParameters& parameters, RandomEngine& engine,
                                     const ContinuousObserver& observer) {
  const ContinuousObjective objective(a, b, a_from_b, parameters.penalty_weight);
  ContinuousCost cost;
  BestPoint best(parameters.prefer_feasible);
  std::vector<ContinuousPoint> current{startingPoint(objective, parameters.initial_points, engine, cost)};
  ContinuousPoint& x = current.front();
  double factor = 1.0;
  best.offer(x, 0);
  const auto report = [&](std::uint32_t iteration) {
    if (observer) {
      observer({iteration, &current, &best.point(), factor});
    }
  };
  report(0);
  for (std::uint32_t iteration = 1; iteration <= parameters.initial_temperature; ++iteration) {
    const double scale = parameters.variable_displacement ? factor : 1.0;
    const PointPair moved = moveRandomly(parameters.move, {x.point_a, x.point_b}, a.boundingBox(),
                                         b.boundingBox(), scale, engine);
    ContinuousPoint next = objective.evaluate(moved.point_a, moved.point_b, cost);
    if (parameters.local_step.enabled) {
      improveLocally(objective, parameters.local_step, next, cost);
    }
    best.offer(next, iteration);
    // The temperature has fallen by one before each comparison and is 0 at the last one.
    const double temperature = parameters.initial_temperature - iteration;
    factor = boltzmannFactor(x.objective, next.objective, parameters.boltzmann_constant, temperature);
    if (next.objective <= x.objective || uniformUnit(engine) < factor) {
      x = next;
    }
    report(iteration);
  }
  return finishedRun(objective, parameters.local_step, parameters.final_repeats, best,
                     parameters.initial_temperature, cost);
}

}  // namespace concave_distance
