#include "mutation.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/random_engine.h"
#include "concave_distance/base/not_computed.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"

namespace concave_distance {
namespace {

// Over a run: e^-5 is 0.7 %.
constexpr double kExponentialDecay = 5.0;

NodeIndex randomNode(const NodeGraph& graph, RandomEngine& engine) {
  return NodeIndex{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
}

NodeIndex moveGene(NodeIndex node, double radius, MeshMetricQuery& query, RandomEngine& engine) {
  const NodeGraph& graph = query.metric().graph();
  const NodeIndex goal = randomNode(graph, engine);
  const double share = uniformUnit(engine);
  if (graph.shell[goal.value] != graph.shell[node.value]) {
    return goal;
  }
  if (!query.metric().hasMatrices()) {
    return radius < kInfinity ? query.nodeInBall(node, radius, share) : goal;
  }
  if (node == goal) {
    return node;
  }
  // An edge longer than the way, so that its last node has its share of the draws too; 1 - share is never 0.
  const double length = query.distanceWithin(node, goal, kInfinity) +
                        static_cast<double>(graph.edges.row(goal.value)[0].length);
  return query.nodeTowards(node, goal, (1.0 - share) * std::min(length, radius), kInfinity);
}

}  // namespace

TrialPoint mutate(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine) {
  TrialPoint moved = point;
  moved.squared_distance = kNotComputed;
  const std::uint32_t genes = uniformIndex(engine, 3);
  if (genes != 1) {
    moved.node_a = moveGene(point.node_a, radius, metric.onA(), engine);
  }
  if (genes != 0) {
    moved.node_b = moveGene(point.node_b, radius, metric.onB(), engine);
  }
  return moved;
}

bool mutateByChance(TrialPoint& point, MutationMethod method, double probability, double radius,
                    PairMetric& metric, RandomEngine& engine) {
  const bool is_hit = uniformUnit(engine) < probability;
  if (method == MutationMethod::RandomMove) {
    if (is_hit) point = mutate(point, radius, metric, engine);
    return is_hit;
  }
  const bool is_b_hit = uniformUnit(engine) < probability;
  if (is_hit) point.node_a = randomNode(metric.onA().metric().graph(), engine);
  if (is_b_hit) point.node_b = randomNode(metric.onB().metric().graph(), engine);
  if (is_hit || is_b_hit) point.squared_distance = kNotComputed;
  return is_hit || is_b_hit;
}

TrialPoint moveBoth(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine) {
  const NodeIndex node_a = moveGene(point.node_a, radius, metric.onA(), engine);
  return {node_a, moveGene(point.node_b, radius, metric.onB(), engine), kNotComputed};
}

TrialPoint randomTrialPoint(const PairObjective& objective, RandomEngine& engine) {
  const NodeIndex node_a = randomNode(objective.gridA().graph(), engine);
  return {node_a, randomNode(objective.gridB().graph(), engine), kNotComputed};
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

double mutationRadius(const GeneticParameters& parameters, const PairObjective& objective,
                      std::uint32_t generation) {
  if (parameters.mutation_radius_cooling == Cooling::Constant) {
    return parameters.mutation_radius.value_or(kInfinity);
  }
  const double radius = parameters.mutation_radius ? *parameters.mutation_radius
                                                   : std::max(objective.gridA().geodesicExtent(),
                                                              objective.gridB().geodesicExtent());
  return radius * coolingFactor(parameters.mutation_radius_cooling, generation, parameters.max_generations);
}

double mutationProbability(const GeneticParameters& parameters, std::uint32_t generation) {
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
