#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "convex_piece.h"

namespace concave_distance {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The squared distance of two points as a quadratic function of x = [p1; p2], each in its own body's frame:
/// x^T W x + w^T x + constant (Carretero, eq. (6.4a)). W has rank 3: a translation of both points costs
/// nothing.
struct PieceObjective {
  Matrix6 weights;  ///< W (6.5)
  /// w = 2 [R01^T (o1 - o2); -R02^T (o1 - o2)]: (6.6) is misprinted, it lacks the factor and the second sign.
  Vector6 linear;
  double constant;  ///< |o1 - o2|^2
};

/// With body 1's frame as frame 0: R01 = 1, o1 = 0.
PieceObjective makePairObjective(const Eigen::Isometry3d& a_from_b);

double value(const PieceObjective& objective, const Vector6& x);

/// A x + b >= 0: p1 in the one piece and p2 in the other (Carretero, eq. (6.4b), b with the other sign). Does
/// not depend on the pose.
struct PairConstraints {
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> rows;
  Eigen::VectorXd offsets;
};
PairConstraints makePairConstraints(const ConvexPiece& a, const ConvexPiece& b);

}  // namespace concave_distance
