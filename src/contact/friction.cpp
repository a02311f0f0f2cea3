#include "concave_distance/contact/friction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "contact_parameter_tables.h"
#include "friction_laws.h"

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

namespace {

/// alpha of Dupont et al.: from 0 below the breakaway to 1 at the greatest deflection.
double slippingShare(double bent, double breakaway) {
  if (bent <= breakaway) return 0.0;
  if (bent >= 1.0) return 1.0;
  return 0.5 - 0.5 * std::cos(kPi * (bent - breakaway) / (1.0 - breakaway));
}

}  // namespace

Eigen::Vector3d turnedInto(const Eigen::Vector3d& normal, const Eigen::Vector3d& deflection) {
  const Eigen::Vector3d in_plane = deflection - normal * normal.dot(deflection);
  const double length = in_plane.norm();
  return length > 0.0 ? Eigen::Vector3d(in_plane * (deflection.norm() / length)) : Eigen::Vector3d::Zero();
}

namespace {

/// Returns the force of bristles that lie in the plane.
Eigen::Vector3d bentBristleForce(const FrictionSettings& settings, const ContactMaterial& material,
                                 double normal_force, const Eigen::Vector3d& sliding,
                                 const Eigen::Vector3d& displacement, BristleState& state) {
  if (!(normal_force > 0.0)) {
    state.deflection.setZero();
    return Eigen::Vector3d::Zero();
  }
  const double speed = sliding.norm();
  const double coefficient = frictionCoefficient(material, settings.stribeck_speed, speed);
  if (!(coefficient > 0.0)) {
    state.deflection.setZero();
    return -normal_force * material.viscous_friction * sliding;
  }
  const Eigen::Vector3d bent = state.deflection + displacement;
  const double share =
      slippingShare(settings.bristle_stiffness * bent.norm() / coefficient, material.breakaway);
  const double decay = share * settings.bristle_stiffness * speed / coefficient;
  const double slip = share * settings.bristle_stiffness * displacement.norm() / coefficient;
  state.deflection = bent / (1.0 + slip);
  const Eigen::Vector3d rate = sliding - decay * state.deflection;
  Eigen::Vector3d friction = settings.bristle_stiffness * state.deflection + settings.bristle_damping * rate +
                             material.viscous_friction * sliding;
  const double limit = material.static_friction + material.viscous_friction * speed;
  const double size = friction.norm();
  if (size > limit) friction *= limit / size;
  return -normal_force * friction;
}

}  // namespace

Eigen::Vector3d bristleForce(const FrictionSettings& settings, const ContactMaterial& material,
                             double normal_force, const Eigen::Vector3d& normal,
                             const Eigen::Vector3d& sliding, const Eigen::Vector3d& displacement,
                             BristleState& state) {
  state.deflection = turnedInto(normal, state.deflection);
  return bentBristleForce(settings, material, normal_force, sliding, displacement, state);
}

Eigen::Vector3d frictionAlong(const FrictionSettings& settings, const ContactMaterial& material,
                              double normal_force, const Eigen::Vector3d& sliding,
                              const Eigen::Vector3d& displacement, BristleState& state) {
  switch (settings.model) {
    case FrictionModel::None:
      break;
    case FrictionModel::RegularisedCoulomb:
      return regularisedCoulombForce(settings, material, normal_force, sliding);
    case FrictionModel::Bristle:
      return bentBristleForce(settings, material, normal_force, sliding, displacement, state);
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d frictionForce(const FrictionSettings& settings, const ContactMaterial& material,
                              double normal_force, const Eigen::Vector3d& normal,
                              const Eigen::Vector3d& sliding, const Eigen::Vector3d& displacement,
                              BristleState& state) {
  if (settings.model == FrictionModel::Bristle) state.deflection = turnedInto(normal, state.deflection);
  return frictionAlong(settings, material, normal_force, sliding, displacement, state);
}

namespace {

FrictionTangent coulombTangent(const FrictionSettings& settings, const ContactMaterial& material,
                               double normal_force, double speed) {
  const double coefficient = frictionCoefficient(material, settings.stribeck_speed, speed);
  const double regularised = std::hypot(speed, settings.regularisation_speed);
  const double share = settings.regularisation_speed / regularised;
  FrictionTangent tangent;
  tangent.damping_across = normal_force * (coefficient + material.viscous_friction * speed) / regularised;
  // d/dv of v / sqrt(v^2 + v_r^2) is v_r^2 / (v^2 + v_r^2)^1.5.
  tangent.damping_along =
      normal_force * (coefficient * share * share / regularised + material.viscous_friction);
  return tangent;
}

// Bristles count as sticking where the surfaces moved by less than a tenth of the deflection that they bear
// in a step, unless they crept on steadily: those that turn back in the next step resist.
bool sticks(const Eigen::Vector3d& sliding, const RecentSliding& recent, double largest_deflection) {
  const double displacement = recent.displacement.norm();
  const double change = (recent.step * sliding - recent.displacement).norm();
  return displacement < 0.1 * largest_deflection && !(change < displacement / 3.0);
}

FrictionTangent bristleTangent(const FrictionSettings& settings, const ContactMaterial& material,
                               double normal_force, const Eigen::Vector3d& sliding,
                               const RecentSliding& recent) {
  const double speed = sliding.norm();
  const double coefficient = frictionCoefficient(material, settings.stribeck_speed, speed);
  if (!(coefficient > 0.0)) return {};
  const double largest_deflection = coefficient / settings.bristle_stiffness;
  double along = 1.0;
  double across = 1.0;
  if (!(speed > 0.0) || sticks(sliding, recent, largest_deflection)) {
    // Bent bristles resist the way back by more: too stiff is stable, too soft is not.
    along = across = 1.0 + recent.bristles.deflection.norm() / largest_deflection;
  } else {
    // As far as they are bent along, they give way.
    const double bent = recent.bristles.deflection.dot(sliding) / (speed * largest_deflection);
    along = std::clamp(1.0 - slippingShare(std::abs(bent), material.breakaway) * bent, 0.0, 2.0);
  }
  FrictionTangent tangent;
  tangent.stiffness_along = along * normal_force * settings.bristle_stiffness;
  tangent.stiffness_across = across * normal_force * settings.bristle_stiffness;
  tangent.damping_along =
      normal_force * (std::min(1.0, along) * settings.bristle_damping + material.viscous_friction);
  tangent.damping_across = normal_force * (settings.bristle_damping + material.viscous_friction);
  return tangent;
}

}  // namespace

FrictionTangent frictionSlopes(const FrictionSettings& settings, const ContactMaterial& material,
                               double normal_force, const Eigen::Vector3d& sliding,
                               const RecentSliding& recent) {
  switch (settings.model) {
    case FrictionModel::None:
      break;
    case FrictionModel::RegularisedCoulomb:
      return coulombTangent(settings, material, normal_force, sliding.norm());
    case FrictionModel::Bristle:
      return bristleTangent(settings, material, normal_force, sliding, recent);
  }
  return {};
}

FrictionTangent frictionTangent(const FrictionSettings& settings, const ContactMaterial& material,
                                double normal_force, const Eigen::Vector3d& normal,
                                const Eigen::Vector3d& sliding, const RecentSliding& recent) {
  FrictionTangent tangent = frictionSlopes(settings, material, normal_force, sliding, recent);
  const double speed = sliding.norm();
  tangent.along = speed > 0.0 ? Eigen::Vector3d(sliding / speed) : normal.unitOrthogonal();
  tangent.across = normal.cross(tangent.along);
  return tangent;
}

}  // namespace concave_distance
