#include "oriented_box_fit.h"

#include <Eigen/Eigenvalues>

namespace concave_distance::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double halfArea(const Vector3d& half) {
  return half.x() * half.y() + half.y() * half.z() + half.z() * half.x();
}

OrientedBox boxAlong(const Matrix3d& axes, const CornerRange& corners) {
  const Matrix3d to_axes = axes.transpose();
  const Vector3d reference = *corners.begin;  // keeps the rounding relative to the box and not to its place
  Vector3d low = Vector3d::Zero();
  Vector3d high = Vector3d::Zero();
  for (const Vector3d* corner = corners.begin; corner != corners.end; ++corner) {
    const Vector3d along = to_axes * (*corner - reference);
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  return {reference + axes * (0.5 * (low + high)), axes, 0.5 * (high - low)};
}

/// Principal axes of the surface, weighted by area; what has no area counts by its corners.
Matrix3d principalAxes(const CornerRange& corners) {
  double weight = 0.0;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d* t = corners.begin; t != corners.end; t += 3) {
    const double area = (t[1] - t[0]).cross(t[2] - t[0]).norm();
    weight += area;
    mean += area * (t[0] + t[1] + t[2]) / 3.0;
  }
  const bool by_corner = !(weight > 0.0);
  if (by_corner) {
    mean.setZero();
    for (const Vector3d* corner = corners.begin; corner != corners.end; ++corner) mean += *corner;
    weight = static_cast<double>(corners.end - corners.begin);
  }
  mean /= weight;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d* t = corners.begin; t != corners.end; t += 3) {
    const double area = by_corner ? 1.0 : (t[1] - t[0]).cross(t[2] - t[0]).norm();
    const Vector3d u = t[0] - mean;
    const Vector3d v = t[1] - mean;
    const Vector3d w = t[2] - mean;
    const Vector3d sum = u + v + w;
    covariance += area * (u * u.transpose() + v * v.transpose() + w * w.transpose() + sum * sum.transpose());
  }
  if (const double largest = covariance.cwiseAbs().maxCoeff(); largest > 0.0) {
    covariance /= largest;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance);
    if (solver.info() == Eigen::Success) {
      // Ascending eigenvalues: the thin direction comes first and is kept as it is.
      Matrix3d axes = solver.eigenvectors();
      axes.col(0).normalize();
      axes.col(1) = (axes.col(1) - axes.col(0).dot(axes.col(1)) * axes.col(0)).normalized();
      axes.col(2) = axes.col(0).cross(axes.col(1));
      return axes;
    }
  }
  return Matrix3d::Identity();
}

/// The plane of the largest triangle with its longest edge; the identity when none has an area.
Matrix3d planeOfLargest(const CornerRange& corners) {
  double largest = 0.0;
  const Vector3d* chosen = nullptr;
  for (const Vector3d* t = corners.begin; t != corners.end; t += 3) {
    const double area = (t[1] - t[0]).cross(t[2] - t[0]).squaredNorm();
    if (area > largest) {
      largest = area;
      chosen = t;
    }
  }
  if (chosen == nullptr) return Matrix3d::Identity();
  Vector3d edge = chosen[1] - chosen[0];
  for (int k = 1; k < 3; ++k) {
    const Vector3d other = chosen[(k + 1) % 3] - chosen[k];
    if (other.squaredNorm() > edge.squaredNorm()) edge = other;
  }
  const Vector3d normal = (chosen[1] - chosen[0]).cross(chosen[2] - chosen[0]).normalized();
  edge = (edge - edge.dot(normal) * normal).normalized();
  Matrix3d axes;
  axes.col(0) = edge;
  axes.col(1) = normal.cross(edge).normalized();
  axes.col(2) = normal;
  return axes.allFinite() ? axes : Matrix3d::Identity();
}

/// Returns whether a box has no thickness and as much area as its triangles: unless they overlap, no box
/// around them has less surface.
bool isFilled(const OrientedBox& box, const CornerRange& corners) {
  if (box.half.minCoeff() > 0.0) return false;
  constexpr double kRounding = 0x1.0p-40;
  double area = 0.0;
  for (const Vector3d* t = corners.begin; t != corners.end; t += 3)
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  return area >= (1.0 - kRounding) * 4.0 * halfArea(box.half);
}

}  // namespace

OrientedBox fitOrientedBox(const CornerRange& corners) {
  OrientedBox best = boxAlong(Matrix3d::Identity(), corners);
  if (isFilled(best, corners)) return best;
  for (const Matrix3d& axes : {principalAxes(corners), planeOfLargest(corners)}) {
    OrientedBox box = boxAlong(axes, corners);
    if (halfArea(box.half) < halfArea(best.half)) best = box;
  }
  return best;
}

}  // namespace concave_distance::detail
