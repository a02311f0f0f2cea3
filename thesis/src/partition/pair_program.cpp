#include "pair_program.h"

namespace concave_distance {

PieceObjective makePairObjective(const Eigen::Isometry3d& a_from_b) {
  const Eigen::Matrix3d rotation = a_from_b.linear();
  const Eigen::Vector3d between = -a_from_b.translation();  // o1 - o2
  PieceObjective objective;
  objective.weights << Eigen::Matrix3d::Identity(), -rotation, -rotation.transpose(),
      Eigen::Matrix3d::Identity();
  objective.linear << 2.0 * between, -2.0 * (rotation.transpose() * between);
  objective.constant = between.squaredNorm();
  return objective;
}

double value(const PieceObjective& objective, const Vector6& x) {
  return x.dot(objective.weights * x) + objective.linear.dot(x) + objective.constant;
}

PairConstraints makePairConstraints(const ConvexPiece& a, const ConvexPiece& b) {
  const Eigen::Index rows_a = a.offsets.size();
  const Eigen::Index rows_b = b.offsets.size();
  PairConstraints constraints;
  constraints.rows.setZero(rows_a + rows_b, 6);
  constraints.rows.topLeftCorner(rows_a, 3) = a.normals;
  constraints.rows.bottomRightCorner(rows_b, 3) = b.normals;
  constraints.offsets.resize(rows_a + rows_b);
  constraints.offsets << a.offsets, b.offsets;
  return constraints;
}

}  // namespace concave_distance
