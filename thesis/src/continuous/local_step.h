#pragma once

#include "continuous_objective.h"
#include "continuous_parameters.h"

namespace concave_distance {

/// Improves a trial point by parameters.repeats local steps; see LocalMove and RepairMethod. With safe repair
/// and with projection the objective never worsens. Points never pass each other. No allocation. (Carretero,
/// sec. 2.1.5: "move closer" and "safe repair", fig. 2.5)
void improveLocally(const ContinuousObjective& objective, const LocalStepParameters& parameters,
                    ContinuousPoint& x, ContinuousCost& cost);

/// Puts a point onto the nearest violated plane, at most `projections` times: onto the body's surface where
/// that succeeds. Its frame is the tree's.
Eigen::Vector3d projectOntoBody(const ConstraintTree& tree, const Eigen::Vector3d& point,
                                std::uint32_t projections, ContinuousCost& cost);

}  // namespace concave_distance
