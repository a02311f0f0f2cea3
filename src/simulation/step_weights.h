#pragma once

#include "concave_distance/contact/contact_linearisation.h"

namespace concave_distance::detail {

/// Weight of the end of a step for one direction, of which the step is `time_scales` long: 1/2, the
/// trapezoidal rule, which keeps energy, where it resolves the motion; more where it is longer than the time
/// scales, so that what is not resolved decays.
double endWeight(double time_scales);

/// The weights of the end of a step by direction: what a step does not resolve in one of them (a friction
/// that sticks) leaves the others (a bounce, rolling) with the trapezoidal rule. The directions are the
/// eigenvectors of what resists the motion, against the inertia.
class StepWeights {
 public:
  /// The trapezoidal rule in all directions, as after construction.
  void reset() { even_ = true; }
  /// @param inverse_mass symmetric, positive definite: from an impulse to the change of the twist
  /// @param resistance step^2 times the stiffness and step times the damping, symmetric, semidefinite
  void choose(const Matrix6d& inverse_mass, const Matrix6d& resistance);
  bool even() const { return even_; }

  /// The share of a wrench that counts at the end.
  Vector6d ofWrench(const Vector6d& wrench) const;
  /// A stiffness or damping with each direction's share of it, symmetric. @param power of the weights
  Matrix6d ofResistance(const Matrix6d& matrix, double power) const;
  /// The mass matrix over twice the weights: what a kick over half the step meets. @param mass the inverse of
  /// inverse_mass
  Matrix6d massInStep(const Matrix6d& mass) const;

 private:
  bool even_ = true;
  Vector6d weights_ = Vector6d::Constant(0.5);
  Matrix6d from_modes_ = Matrix6d::Identity();  ///< of wrenches
  Matrix6d into_modes_ = Matrix6d::Identity();
};

}  // namespace concave_distance::detail
