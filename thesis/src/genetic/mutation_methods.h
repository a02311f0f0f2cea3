#pragma once

#include <cstdint>

#include "base/random_engine.h"
#include "comb_ga_parameters.h"
#include "search/pair_metric.h"
#include "search/pair_objective.h"

namespace concave_distance {

/// Moves both genes at random (Carretero, sec. 3.2.2.b). @param radius r_max, metres
TrialPoint moveBoth(const TrialPoint& point, double radius, PairMetric& metric, RandomEngine& engine);

/// Mutates an individual, or not, as the dice fall (MutationMethod). True when it was mutated; its distance
/// is not computed then.
/// @param probability p_m, of the individual or of each gene
/// @param radius r_max of random moves, metres
bool mutateByChance(TrialPoint& point, MutationMethod method, double probability, double radius,
                    PairMetric& metric, RandomEngine& engine);

/// The share of its first value that a quantity has in a generation, from 1; at most 1.
double coolingFactor(Cooling cooling, std::uint32_t generation, std::uint32_t max_generations);

/// r_max of a generation (Carretero, sec. 3.3.2.c), metres; infinite: anywhere on the shell.
double mutationRadius(const CombGaParameters& parameters, const PairObjective& objective,
                      std::uint32_t generation);

/// p_m of a generation: cools, or rises, from its value in the first to `factor` times it in the last.
double mutationProbability(const CombGaParameters& parameters, std::uint32_t generation);

}  // namespace concave_distance
