#include "continuous_objective.h"

namespace concave_distance {

ContinuousObjective::ContinuousObjective(const ConstraintTree& a, const ConstraintTree& b,
                                         const Eigen::Isometry3d& a_from_b, double penalty_weight)
    : a_(&a), b_(&b), a_from_b_(a_from_b), penalty_weight_(penalty_weight) {}

ContinuousPoint ContinuousObjective::evaluate(const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b,
                                              ContinuousCost& cost) const {
  ContinuousPoint x;
  x.point_a = point_a;
  x.point_b = point_b;
  x.state_a = evaluatePoint(*a_, point_a);
  x.state_b = evaluatePoint(*b_, point_b);
  x.squared_distance = displacementToB(x).squaredNorm();
  x.objective = x.squared_distance + penalty_weight_ * (x.state_a.violation + x.state_b.violation);
  ++cost.evaluations;
  cost.constraints += x.state_a.constraints_evaluated + x.state_b.constraints_evaluated;
  return x;
}

}  // namespace concave_distance
