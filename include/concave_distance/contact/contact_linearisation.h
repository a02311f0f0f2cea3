#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace concave_distance {

/// Rows and columns: linear x, y, z, angular x, y, z.
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Says how the wrench of a pair's contacts on B changes with a small motion of B against A, all about A's
/// origin in A's axes. Both matrices are symmetric and positive semidefinite: what has no such part is left
/// out. Zero without contact.
struct ContactLinearisation {
  /// Minus the derivative by the displacement (metres, radians): N/m, N, N m/rad.
  Matrix6d stiffness = Matrix6d::Zero();
  /// Minus the derivative by the twist (m/s, rad/s): N s/m, N s, N m s/rad.
  Matrix6d damping = Matrix6d::Zero();
};

/// [n^T, (x cross n)^T]: the wrench about the origin of a unit force along `direction` at `point`.
inline Vector6d wrenchRow(const Eigen::Vector3d& direction, const Eigen::Vector3d& point) {
  Vector6d row;
  row << direction, point.cross(direction);
  return row;
}

/// Adds J^T k J with J of wrenchRow(): a spring, or damper, of `coefficient` (>= 0) along the unit
/// vector `direction` at `point`. Of the sum the upper triangle counts; see mirrorUpper().
inline void addDirection(double coefficient, const Eigen::Vector3d& direction, const Eigen::Vector3d& point,
                         Matrix6d& sum) {
  const Vector6d row = wrenchRow(direction, point);
  const Vector6d scaled = coefficient * row;
  sum.noalias() += row * scaled.transpose();
}

/// The same of a torsional spring, or damper, about the unit vector `axis`.
inline void addAxis(double coefficient, const Eigen::Vector3d& axis, Matrix6d& sum) {
  for (int column = 0; column < 3; ++column) {
    sum.col(3 + column).segment(3, column + 1) += coefficient * axis[column] * axis.head(column + 1);
  }
}

/// Copies the upper triangle into the lower, after the last addDirection() or addAxis().
inline void mirrorUpper(Matrix6d& sum) {
  for (int column = 0; column < 6; ++column) {
    for (int row = 0; row < column; ++row) sum(column, row) = sum(row, column);
  }
}

}  // namespace concave_distance
