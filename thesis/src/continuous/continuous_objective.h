#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "constraint_tree.h"
#include "feasibility.h"

namespace concave_distance {

/// What a continuous search has cost so far.
struct ContinuousCost {
  std::uint64_t evaluations = 0;  ///< of the objective: distances of point pairs computed
  std::uint64_t constraints = 0;  ///< constraint rows evaluated
  std::uint64_t local_steps = 0;  ///< move closer, slide or repair steps tried

  /// Floating-point operations by the thesis's rule: 26 a point pair, 6 a constraint (Carretero, sec. 2.1.4).
  std::uint64_t flops() const { return 26 * evaluations + 6 * constraints; }
};

/// A trial point x = [1p1, 2p2] (Carretero, eq. (2.3)) with its objective.
struct ContinuousPoint {
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();  ///< A's frame, metres
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();  ///< B's frame, metres
  double squared_distance = 0.0;                      ///< square metres
  double objective = 0.0;                             ///< f of eq. (2.4), square metres
  PointState state_a;
  PointState state_b;
  /// Share of the way to the other point that a sliding step tries next; see LocalMove::SlideCloser.
  double stride = 1.0;

  bool isFeasible() const { return state_a.is_feasible && state_b.is_feasible; }
};

/// f = d^2 + k_p q_v (Carretero, eq. (2.4), (2.5)) of two bodies at one relative pose.
/// The trees must outlive the objective.
class ContinuousObjective {
 public:
  /// @param a_from_b pose of B in A's frame
  /// @param penalty_weight k_p, metres: scale it with the bodies
  ContinuousObjective(const ConstraintTree& a, const ConstraintTree& b, const Eigen::Isometry3d& a_from_b,
                      double penalty_weight);

  const ConstraintTree& a() const { return *a_; }
  const ConstraintTree& b() const { return *b_; }
  const Eigen::Isometry3d& aFromB() const { return a_from_b_; }

  /// @param point_a, point_b each in its body's frame
  ContinuousPoint evaluate(const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b,
                           ContinuousCost& cost) const;
  /// From A's point to B's, in A's frame.
  Eigen::Vector3d displacementToB(const ContinuousPoint& x) const {
    return a_from_b_ * x.point_b - x.point_a;
  }
  /// A direction of A's frame in B's.
  Eigen::Vector3d inB(const Eigen::Vector3d& direction) const {
    return a_from_b_.linear().transpose() * direction;
  }

 private:
  const ConstraintTree* a_;
  const ConstraintTree* b_;
  Eigen::Isometry3d a_from_b_;
  double penalty_weight_;
};

}  // namespace concave_distance
