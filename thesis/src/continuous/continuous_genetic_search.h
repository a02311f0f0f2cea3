#pragma once

#include "base/random_engine.h"
#include "constraint_tree.h"
#include "continuous_parameters.h"
#include "continuous_result.h"

namespace concave_distance {

/// cont-GA (Carretero, sec. 2.3, fig. 2.13): evaluation, selection, mating, mutation, local step, and again;
/// the best point evaluated is kept. The local step stands after selection and mutation (sec. 2.3.3). Weights
/// of selection are 1 / f, as f is to be small.
/// @param a_from_b pose of B in A's frame
/// @param parameters validated
/// @param observer called once a generation when not empty
/// Deterministic for one state of the engine. Never throws.
ContinuousResult continuousGeneticSearch(const ConstraintTree& a, const ConstraintTree& b,
                                         const Eigen::Isometry3d& a_from_b,
                                         const ContinuousGeneticParameters& parameters, RandomEngine& engine,
                                         const ContinuousObserver& observer = {});

}  // namespace concave_distance
