#pragma once

#include "base/random_engine.h"
#include "constraint_tree.h"
#include "continuous_parameters.h"
#include "continuous_result.h"

namespace concave_distance {

/// cont-SA (Carretero, sec. 2.2, fig. 2.9): one trial point, moved at random and then locally; accepted when
/// better, else with the probability p_b of (2.6); the temperature falls by one an iteration, from t_ini to
/// 0; the best point met is kept.
/// @param a_from_b pose of B in A's frame
/// @param parameters validated
/// @param observer called once an iteration when not empty
/// Deterministic for one state of the engine. Never throws.
ContinuousResult continuousAnnealing(const ConstraintTree& a, const ConstraintTree& b,
                                     const Eigen::Isometry3d& a_from_b,
                                     const ContinuousAnnealingParameters& parameters, RandomEngine& engine,
                                     const ContinuousObserver& observer = {});

}  // namespace concave_distance
