#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "constraint_tree.h"

namespace concave_distance {

/// Where a point stands with respect to a body. Metres, body frame.
struct PointState {
  bool is_feasible = false;  ///< inside the body or on its surface
  /// q_v of eq. (2.5), 0 exactly when feasible. Outside a solid: the sum of its violated constraints. In a
  /// concavity: the cheapest way out, the distance to its nearest wall (C-1) or the sum of a solid's violated
  /// constraints where a solid stands in the concavity; summed over the concavities that hold the point. So
  /// it vanishes, continuously, on the body's surface.
  double violation = 0.0;
  /// q_min, not negative. Feasible: the point may move this far in any direction and stays feasible (a lower
  /// bound of the distance to the surface). Infeasible: the distance to the furthest violated constraint.
  double reach = 0.0;
  /// Infeasible: the unit direction in which `reach` leads onto that constraint's plane. Feasible: zero.
  Eigen::Vector3d repair_direction = Eigen::Vector3d::Zero();
  std::uint32_t constraints_evaluated = 0;
};

/// The feasibility walk (Carretero, fig. 2.4) with the values that penalty and local step need. Where the
/// hulls of sibling pieces overlap fig. 2.4 errs; this follows inside(n) = in(n) and no child c with
/// inside(c), for any depth. O(constraints of the pieces met), no allocation.
PointState evaluatePoint(const ConstraintTree& tree, const Eigen::Vector3d& point);

}  // namespace concave_distance
