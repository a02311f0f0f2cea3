#include "mutation_methods.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "concave_distance/base/not_computed.h"
#include "search/grid/mesh_metric.h"
#include "search/mutation.h"

namespace concave_distance {
namespace {

// Over a run: e^-5 is 0.7 %.
constexpr double kExponentialDecay = 5.0;

}  // namespace

TrialPoint moveBoth(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine) {
  const NodeIndex node_a = moveGene(point.node_a, radius, metric.onA(), engine);
  return {node_a, moveGene(point.node_b, radius, metric.onB(), engine), kNotComputed};
}

bool mutateByChance(TrialPoint& point, MutationMethod method, double probability, double radius,
                    PairMetric& metric, RandomEngine& engine) {
  const bool is_hit = uniformUnit(engine) < probability;
  if (method == MutationMethod::RandomMove) {
    if (is_hit) point = mutate(point, metric, engine, radius);
    return is_hit;
  }
  const bool is_b_hit = uniformUnit(engine) < probability;
  if (is_hit) point.node_a = randomNode(metric.onA().graph(), engine);
  if (is_b_hit) point.node_b = randomNode(metric.onB().graph(), engine);
  if (is_hit || is_b_hit) point.squared_distance = kNotComputed;
  return is_hit || is_b_hit;
}

double coolingFactor(Cooling cooling, std::uint32_t generation, std::uint32_t max_generations) {
  const double all = std::max(1U, max_generations);
  const double temperature = std::max(1.0, all + 1.0 - generation);
  switch (cooling) {
    case Cooling::Constant:
      return 1.0;
    case Cooling::Linear:
      return temperature / all;
    case Cooling::Exponential:
      return std::exp(-kExponentialDecay * generation / all);
    case Cooling::Boltzmann:
      return std::exp(1.0 - all / temperature);
  }
  return 1.0;
}

double mutationRadius(const CombGaParameters& parameters, const PairObjective& objective,
                      std::uint32_t generation) {
  if (parameters.mutation_radius_cooling == Cooling::Constant) {
    return parameters.mutation_radius.value_or(kInfinity);
  }
  const double radius = parameters.mutation_radius ? *parameters.mutation_radius
                                                   : std::max(objective.gridA().geodesicExtent(),
                                                              objective.gridB().geodesicExtent());
  return radius * coolingFactor(parameters.mutation_radius_cooling, generation, parameters.max_generations);
}

double mutationProbability(const CombGaParameters& parameters, std::uint32_t generation) {
  const double first = parameters.mutation_probability.value_or(1.0 / parameters.population_size);
  double share = parameters.max_generations > 1
                     ? static_cast<double>(generation - 1) / (parameters.max_generations - 1)
                     : 0.0;
  if (parameters.mutation_probability_cooling != Cooling::Linear) {
    share =
        1.0 - coolingFactor(parameters.mutation_probability_cooling, generation, parameters.max_generations);
  }
  return std::min(1.0, first * (1.0 + share * (parameters.final_mutation_probability_factor - 1.0)));
}

}  // namespace concave_distance
