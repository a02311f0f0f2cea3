#pragma once

#include <utility>

#include "base/random_engine.h"
#include "continuous_objective.h"
#include "continuous_parameters.h"
#include "random_moves.h"

namespace concave_distance {

/// Two children of two parents, body by body on the line that joins the parents' points.
/// Linear scaling (2.14): each child and body with its own random number. Fitness weighted (2.15): the first
/// child stands at f_1 / (f_1 + f_2) of the way from parent 1 to parent 2, nearer to the better one, halfway
/// when both are 0; (2.15) has no randomness, so that it would give the same child twice: the second one
/// stands at random between the first child and the better parent. FitnessWeightedTwice gives it twice.
std::pair<PointPair, PointPair> mateContinuous(ContinuousMating mating, const ContinuousPoint& parent_1,
                                               const ContinuousPoint& parent_2, RandomEngine& engine);

}  // namespace concave_distance
