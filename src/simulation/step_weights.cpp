#include "step_weights.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace concave_distance::detail {
namespace {

// What a step does not resolve keeps (1 - w) / w of itself from step to step.
constexpr double kLargestEndWeight = 0.75;

}  // namespace

double endWeight(double time_scales) {
  return time_scales > 1.0 ? 0.5 + (kLargestEndWeight - 0.5) * (1.0 - 1.0 / time_scales) : 0.5;
}

// With inverse_mass = L L^T the modes are those of L^T R L = Q diag(time scales) Q^T, and a wrench is
// L^-T Q times its share of each.
void StepWeights::choose(const Matrix6d& inverse_mass, const Matrix6d& resistance) {
  even_ = true;
  // The sum of all time scales: none is longer.
  if (!(inverse_mass.cwiseProduct(resistance).sum() > 1.0)) return;
  const Eigen::LLT<Matrix6d> factors(inverse_mass);
  const Matrix6d lower = factors.matrixL();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> modes(lower.transpose() * resistance * lower);
  into_modes_.noalias() = modes.eigenvectors().transpose() * lower.transpose();
  from_modes_ = modes.eigenvectors();
  factors.matrixU().solveInPlace(from_modes_);
  for (int mode = 0; mode < 6; ++mode) {
    weights_[mode] = endWeight(modes.eigenvalues()[mode]);
    even_ = even_ && weights_[mode] == 0.5;
  }
}

Vector6d StepWeights::ofWrench(const Vector6d& wrench) const {
  if (even_) return 0.5 * wrench;
  return from_modes_ * weights_.cwiseProduct(into_modes_ * wrench);
}

Matrix6d StepWeights::ofResistance(const Matrix6d& matrix, double power) const {
  if (even_) return std::pow(0.5, power) * matrix;
  const Vector6d roots = weights_.array().pow(0.5 * power);
  const Matrix6d scaled = from_modes_ * roots.asDiagonal() * into_modes_;
  const Matrix6d sum = scaled * matrix * scaled.transpose();
  return 0.5 * (sum + sum.transpose());
}

Matrix6d StepWeights::massInStep(const Matrix6d& mass) const {
  if (even_) return mass;
  return from_modes_ * (0.5 * weights_.cwiseInverse()).asDiagonal() * from_modes_.transpose();
}

}  // namespace concave_distance::detail
