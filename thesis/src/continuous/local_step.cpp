#include "local_step.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

/// Beyond the plane by this share of the body's size, so that rounding leaves the point on the right side.
constexpr double kProjectionMargin = 1e-11;
constexpr double kSmallestStride = 1e-4;

/// Puts a point of known state onto violated planes until it is feasible or the count is used up.
Eigen::Vector3d projected(const ConstraintTree& tree, Eigen::Vector3d point, PointState state,
                          std::uint32_t projections, ContinuousCost& cost) {
  const double margin = kProjectionMargin * tree.diameter() + 2.0 * tree.tolerance();
  for (std::uint32_t i = 0; i < projections && !state.is_feasible; ++i) {
    point += (state.reach + margin) * state.repair_direction;
    if (i + 1 < projections) {
      state = evaluatePoint(tree, point);
      cost.constraints += state.constraints_evaluated;
    }
  }
  return point;
}

/// Where one body's point goes; `way` leads from it to its counterpart, in its own frame.
Eigen::Vector3d stepped(const ConstraintTree& tree, const Eigen::Vector3d& point, const PointState& state,
                        const Eigen::Vector3d& displacement, double stride,
                        const LocalStepParameters& parameters, ContinuousCost& cost) {
  const double distance = displacement.norm();
  if (!state.is_feasible) {
    if (parameters.repair == RepairMethod::Project) {
      return projected(tree, point, state, parameters.projections, cost);
    }
    return distance > 0.0
               ? Eigen::Vector3d(point - parameters.repair_scale * state.reach / distance * displacement)
               : point;
  }
  if (parameters.move == LocalMove::SlideCloser) {
    const Eigen::Vector3d target = point + stride * displacement;
    const PointState there = evaluatePoint(tree, target);
    cost.constraints += there.constraints_evaluated;
    return projected(tree, target, there, parameters.projections, cost);
  }
  // Each goes half of the way at most: points that meet do not pass each other.
  return distance > 0.0 ? Eigen::Vector3d(point + std::min(state.reach / distance, 0.5) * displacement)
                        : point;
}

/// One step of both points. True when it was kept.
bool step(const ContinuousObjective& objective, const LocalStepParameters& parameters, ContinuousPoint& x,
          ContinuousCost& cost) {
  ++cost.local_steps;
  const Eigen::Vector3d displacement = objective.displacementToB(x);
  const Eigen::Vector3d point_a =
      stepped(objective.a(), x.point_a, x.state_a, displacement, x.stride, parameters, cost);
  // A sliding point of B goes to where A's has come, as in von Neumann's alternating projections: two that
  // went for each other's old places would swap them sideways and never meet.
  const bool alternates = parameters.move == LocalMove::SlideCloser;
  const Eigen::Vector3d displacement_for_b =
      alternates ? Eigen::Vector3d(displacement + x.point_a - point_a) : displacement;
  const Eigen::Vector3d point_b = stepped(objective.b(), x.point_b, x.state_b,
                                          -objective.inB(displacement_for_b), x.stride, parameters, cost);
  ContinuousPoint moved = objective.evaluate(point_a, point_b, cost);
  const bool is_kept = parameters.repair == RepairMethod::MoveAway || moved.objective <= x.objective;
  const double stride = x.stride;
  if (is_kept) {
    x = moved;
  }
  // A shorter way next time after a failure, a longer one after success; anew from the whole way when it got
  // nowhere.
  x.stride = is_kept ? std::min(1.0, 2.0 * stride) : 0.25 * stride;
  if (x.stride < kSmallestStride) {
    x.stride = 1.0;
  }
  return is_kept;
}

}  // namespace

void improveLocally(const ContinuousObjective& objective, const LocalStepParameters& parameters,
                    ContinuousPoint& x, ContinuousCost& cost) {
  for (std::uint32_t i = 0; i < parameters.repeats; ++i) {
    const bool is_kept = step(objective, parameters, x, cost);
    if (!is_kept && parameters.move == LocalMove::MoveCloser) {
      return;  // the same step would fail again
    }
  }
}

Eigen::Vector3d projectOntoBody(const ConstraintTree& tree, const Eigen::Vector3d& point,
                                std::uint32_t projections, ContinuousCost& cost) {
  const PointState state = evaluatePoint(tree, point);
  cost.constraints += state.constraints_evaluated;
  return projected(tree, point, state, projections, cost);
}

}  // namespace concave_distance
