#include "feasibility.h"

#include <algorithm>
#include <limits>

namespace concave_distance {
namespace {

/// The constraints of one piece at a point.
struct PieceValues {
  double least;             ///< min(A p + b)
  std::uint32_t least_row;  ///< of the tree's constraints
  double violated_sum;      ///< sum of -q_i over the violated constraints, beyond the tolerance
};

PieceValues valuesAt(const ConstraintTree& tree, const TreePiece& piece, const Eigen::Vector3d& point) {
  PieceValues values{std::numeric_limits<double>::infinity(), piece.first_constraint, 0.0};
  const std::uint32_t end = piece.first_constraint + piece.constraint_count;
  for (std::uint32_t row = piece.first_constraint; row < end; ++row) {
    const double q = tree.constraints()[row].value(point);
    if (q < values.least) {
      values.least = q;
      values.least_row = row;
    }
    if (q < -tree.tolerance()) {
      values.violated_sum -= q;
    }
  }
  return values;
}

PointState evaluateSolid(const ConstraintTree& tree, const TreePiece& piece, const Eigen::Vector3d& point);

/// A concavity: is_feasible when the point is not in it, and then `reach` is how far it may move without
/// entering.
PointState evaluateConcavity(const ConstraintTree& tree, const TreePiece& piece,
                             const Eigen::Vector3d& point) {
  PointState state;
  const PieceValues values = valuesAt(tree, piece, point);
  state.constraints_evaluated = piece.constraint_count;
  if (values.least <= tree.tolerance()) {
    state.is_feasible = true;
    state.reach = std::max(0.0, -values.least);
    return state;
  }
  // Inside its hull: out through the nearest wall, or into the cheapest of the solids that stand in it.
  state.violation = values.least;
  state.reach = values.least;
  state.repair_direction = -tree.constraints()[values.least_row].normal;
  for (std::uint32_t i = 0; i < piece.child_count; ++i) {
    const PointState solid = evaluateSolid(tree, tree.pieces()[piece.first_child + i], point);
    const std::uint32_t evaluated = state.constraints_evaluated + solid.constraints_evaluated;
    const bool is_deeper = solid.is_feasible && (!state.is_feasible || solid.reach > state.reach);
    const bool is_cheaper = !solid.is_feasible && !state.is_feasible && solid.violation < state.violation;
    if (is_deeper || is_cheaper) {
      state = solid;
    }
    state.constraints_evaluated = evaluated;
  }
  return state;
}

PointState evaluateSolid(const ConstraintTree& tree, const TreePiece& piece, const Eigen::Vector3d& point) {
  PointState state;
  const PieceValues values = valuesAt(tree, piece, point);
  state.constraints_evaluated = piece.constraint_count;
  if (values.least < -tree.tolerance()) {
    state.violation = values.violated_sum;
    state.reach = -values.least;
    state.repair_direction = tree.constraints()[values.least_row].normal;
    return state;
  }
  state.is_feasible = true;
  state.reach = std::max(0.0, values.least);
  for (std::uint32_t i = 0; i < piece.child_count; ++i) {
    const PointState hole = evaluateConcavity(tree, tree.pieces()[piece.first_child + i], point);
    state.constraints_evaluated += hole.constraints_evaluated;
    if (hole.is_feasible) {
      if (state.is_feasible) {
        state.reach = std::min(state.reach, hole.reach);
      }
      continue;
    }
    // Hulls of siblings may overlap: every concavity that holds the point counts, the deepest is left first.
    if (state.is_feasible || hole.reach > state.reach) {
      state.reach = hole.reach;
      state.repair_direction = hole.repair_direction;
    }
    state.is_feasible = false;
    state.violation += hole.violation;
  }
  return state;
}

}  // namespace

PointState evaluatePoint(const ConstraintTree& tree, const Eigen::Vector3d& point) {
  return evaluateSolid(tree, tree.pieces().front(), point);
}

}  // namespace concave_distance
