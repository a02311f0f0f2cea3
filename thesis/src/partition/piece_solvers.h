#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "convex_distance.h"
#include "convex_piece.h"

namespace concave_distance {

/// The conventional method for one pair of pieces: the quadratic program of Carretero, eq. (6.4)-(6.6), by
/// ALGLIB's active-set solver (minqp, BLEIC), which takes semidefinite matrices and a starting point. Each
/// piece is shifted to its centre and both scaled to unit size, so that the solver's tolerances mean the same
/// for all bodies. The constraints are handed over once. Keeps references to the pieces. Not thread-safe.
class QuadraticPieceSolver {
 public:
  QuadraticPieceSolver(const ConvexPiece& a, const ConvexPiece& b);
  ~QuadraticPieceSolver();
  QuadraticPieceSolver(QuadraticPieceSolver&&) noexcept;
  QuadraticPieceSolver& operator=(QuadraticPieceSolver&&) noexcept;

  /// @param start where to begin; nullptr: the pieces' centres. Never throws.
  PieceProposal solve(const Eigen::Isometry3d& a_from_b, const PiecePoints* start);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A piece as FCL has it.
class GjkShape {
 public:
  explicit GjkShape(const ConvexPiece& piece);
  ~GjkShape();
  GjkShape(GjkShape&&) noexcept;
  GjkShape& operator=(GjkShape&&) noexcept;
  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Beside it: FCL's GJK (over libccd) on the same pieces. It has no warm start and does not count its
/// iterations. Pieces that meet count as failed: judgeProposal decides. Never throws.
PieceProposal solveGjk(const GjkShape& a, const GjkShape& b, const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance
