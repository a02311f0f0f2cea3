#include "rigid_body.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace concave_distance {

RigidBody::RigidBody(const MassProperties& properties, const std::string& where)
    : mass_(properties.mass), centre_in_body_(properties.centre_in_body) {
  properties.validate(where);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(properties.inertia);
  moments_ = solver.eigenvalues();
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  body_from_principal_ = Eigen::Quaterniond(axes).normalized();
}

RigidBodyState RigidBody::stateAt(const Eigen::Isometry3d& world_from_body, const Eigen::Vector3d& velocity,
                                  const Eigen::Vector3d& angular_velocity) const {
  RigidBodyState state;
  state.centre = world_from_body * centre_in_body_;
  state.world_from_principal =
      (Eigen::Quaterniond(world_from_body.linear()) * body_from_principal_).normalized();
  state.velocity = velocity;
  state.angular_momentum =
      state.world_from_principal *
      (moments_.cwiseProduct(state.world_from_principal.conjugate() * angular_velocity)).eval();
  return state;
}

Eigen::Isometry3d RigidBody::worldFromBody(const RigidBodyState& state) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (state.world_from_principal * body_from_principal_.conjugate()).normalized().toRotationMatrix();
  pose.translation() = state.centre - pose.linear() * centre_in_body_;
  return pose;
}

Eigen::Vector3d RigidBody::turnOf(const RigidBodyState& state,
                                  const Eigen::Vector3d& angular_momentum) const {
  const Eigen::Vector3d momentum = state.world_from_principal.conjugate() * angular_momentum;
  return state.world_from_principal * momentum.cwiseQuotient(moments_).eval();
}

Eigen::Vector3d RigidBody::angularVelocity(const RigidBodyState& state) const {
  return turnOf(state, state.angular_momentum);
}

double RigidBody::kineticEnergy(const RigidBodyState& state) const {
  const Eigen::Vector3d momentum = state.world_from_principal.conjugate() * state.angular_momentum;
  return 0.5 * (mass_ * state.velocity.squaredNorm() + momentum.cwiseAbs2().cwiseQuotient(moments_).sum());
}

Eigen::Matrix3d RigidBody::inertia(const RigidBodyState& state) const {
  const Eigen::Matrix3d axes = state.world_from_principal.toRotationMatrix();
  return axes * moments_.asDiagonal() * axes.transpose();
}

void RigidBody::kick(const Wrench& about_centre, double step, RigidBodyState& state) const {
  state.velocity += step / mass_ * about_centre.force;
  state.angular_momentum += step * about_centre.torque;
}

Drift RigidBody::drift(double step, RigidBodyState& state) const {
  Drift drift;
  drift.shift = step * state.velocity;
  state.centre += drift.shift;
  Eigen::Quaterniond& rotation = state.world_from_principal;
  Eigen::Vector3d momentum = rotation.conjugate() * state.angular_momentum;
  const auto turn = [&](int axis, double part) {
    const double angle = part * step * momentum[axis] / moments_[axis];
    const Eigen::Quaterniond partial(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)));
    rotation = rotation * partial;
    momentum = partial.conjugate() * momentum;
    drift.turn += std::abs(angle);
  };
  turn(0, 0.5);
  turn(1, 0.5);
  turn(2, 1.0);
  turn(1, 0.5);
  turn(0, 0.5);
  const double norm = rotation.norm();
  drift.norm_drift = norm - 1.0;
  rotation.coeffs() /= norm;
  return drift;
}

}  // namespace concave_distance
