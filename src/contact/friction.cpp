#include "concave_distance/contact/friction.h"

#include <cmath>

#include "contact_parameter_tables.h"

namespace concave_distance {

std::string_view toString(FrictionModel model) {
  switch (model) {
    case FrictionModel::None:
      return "none";
    case FrictionModel::RegularisedCoulomb:
      return "regularised_coulomb";
    case FrictionModel::Bristle:
      return "bristle";
  }
  return "unknown";
}

void FrictionSettings::validate(const std::string& where) const {
  requireAllowed(frictionParameters(), *this, where);
}

double frictionCoefficient(const ContactMaterial& material, double stribeck_speed, double speed) {
  const double ratio = speed / stribeck_speed;
  return material.dynamic_friction +
         (material.static_friction - material.dynamic_friction) * std::exp(-ratio * ratio);
}

Eigen::Vector3d regularisedCoulombForce(const FrictionSettings& settings, const ContactMaterial& material,
                                        double normal_force, const Eigen::Vector3d& sliding) {
  const double speed = sliding.norm();
  const double coefficient =
      frictionCoefficient(material, settings.stribeck_speed, speed) + material.viscous_friction * speed;
  return -coefficient * normal_force / std::hypot(speed, settings.regularisation_speed) * sliding;
}

Eigen::Vector3d bristleForce(const FrictionSettings& settings, const ContactMaterial& material,
                             double normal_force, const Eigen::Vector3d& normal,
                             const Eigen::Vector3d& sliding, double step, BristleState& state) {
  if (!(normal_force > 0.0)) {
    state.deflection.setZero();
    return Eigen::Vector3d::Zero();
  }
  // Turned, not projected: a region that rolls keeps the length of its bristles.
  const double length = state.deflection.norm();
  Eigen::Vector3d before = state.deflection - normal * normal.dot(state.deflection);
  const double in_plane = before.norm();
  before = in_plane > 0.0 ? Eigen::Vector3d(before * (length / in_plane)) : Eigen::Vector3d::Zero();

  const double speed = sliding.norm();
  const double coefficient = frictionCoefficient(material, settings.stribeck_speed, speed);
  if (!(coefficient > 0.0)) {
    state.deflection.setZero();
    return -normal_force * material.viscous_friction * sliding;
  }
  const double decay = settings.bristle_stiffness * speed / coefficient;
  state.deflection = (before + step * sliding) / (1.0 + step * decay);
  const Eigen::Vector3d rate = sliding - decay * state.deflection;
  Eigen::Vector3d friction = settings.bristle_stiffness * state.deflection + settings.bristle_damping * rate +
                             material.viscous_friction * sliding;
  const double limit = material.static_friction + material.viscous_friction * speed;
  const double size = friction.norm();
  if (size > limit) friction *= limit / size;
  return -normal_force * friction;
}

Eigen::Vector3d frictionForce(const FrictionSettings& settings, const ContactMaterial& material,
                              double normal_force, const Eigen::Vector3d& normal,
                              const Eigen::Vector3d& sliding, double step, BristleState& state) {
  switch (settings.model) {
    case FrictionModel::None:
      break;
    case FrictionModel::RegularisedCoulomb:
      return regularisedCoulombForce(settings, material, normal_force, sliding);
    case FrictionModel::Bristle:
      return bristleForce(settings, material, normal_force, normal, sliding, step, state);
  }
  return Eigen::Vector3d::Zero();
}

FrictionRates frictionRates(const FrictionSettings& settings, const ContactMaterial& material,
                            double normal_force) {
  switch (settings.model) {
    case FrictionModel::None:
      return {};
    case FrictionModel::RegularisedCoulomb:
      return {0.0, (material.static_friction / settings.regularisation_speed + material.viscous_friction) *
                       normal_force};
    case FrictionModel::Bristle:
      return {settings.bristle_stiffness * normal_force,
              (settings.bristle_damping + material.viscous_friction) * normal_force};
  }
  return {};
}

}  // namespace concave_distance
