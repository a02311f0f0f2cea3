#pragma once

#include "base/random_engine.h"
#include "concave_distance/search/genetic_parameters.h"
#include "pair_metric.h"
#include "pair_objective.h"

namespace concave_distance {

/// Random move (Carretero, sec. 3.2.2.b, 3.3.2.c) of gene A, gene B or both, with equal chances: a node is
/// drawn from the whole body, and the gene moves on a shortest path towards it by a uniformly random length
/// within `radius`, metres (infinite: up to the whole way). To a node on another shell it jumps.
/// Beyond the matrices no path is searched across the body: with a finite radius the gene moves to a random
/// node within it, without one to the node drawn.
/// The result's distance is not computed.
TrialPoint mutate(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine);

/// The same of both genes (Carretero, sec. 3.2.2.b).
TrialPoint moveBoth(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine);

/// Mutates an individual, or not, as the dice fall (MutationMethod). True when it was mutated; its distance
/// is not computed then.
/// @param probability p_m, of the individual or of each gene
/// @param radius r_max of random moves, metres
bool mutateByChance(TrialPoint& point, MutationMethod method, double probability, double radius,
                    PairMetric& metric, RandomEngine& engine);

/// A uniformly random node pair, its distance not computed.
TrialPoint randomTrialPoint(const PairObjective& objective, RandomEngine& engine);

/// The share of its first value that a quantity has in a generation, from 1; at most 1.
double coolingFactor(Cooling cooling, std::uint32_t generation, std::uint32_t max_generations);

/// r_max of a generation (Carretero, sec. 3.3.2.c), metres; infinite: anywhere on the shell.
double mutationRadius(const GeneticParameters& parameters, const PairObjective& objective,
                      std::uint32_t generation);

/// p_m of a generation: cools, or rises, from its value in the first to `factor` times it in the last.
double mutationProbability(const GeneticParameters& parameters, std::uint32_t generation);

}  // namespace concave_distance
