#include "concave_distance/contact/normal_force.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "contact_parameter_tables.h"

namespace concave_distance {

std::string_view toString(NormalForceModel model) {
  switch (model) {
    case NormalForceModel::QuasiStatic:
      return "quasi_static";
    case NormalForceModel::SpringDashpot:
      return "spring_dashpot";
    case NormalForceModel::Hertz:
      return "hertz";
    case NormalForceModel::HuntCrossley:
      return "hunt_crossley";
    case NormalForceModel::ElasticFoundation:
      return "elastic_foundation";
  }
  return "unknown";
}

std::string_view toString(ForceDistribution distribution) {
  return distribution == ForceDistribution::Pressure ? "pressure" : "lumped";
}

double quasiStaticForce(const ContactGeometry& contact, double contact_modulus, double loading_coefficient,
                        double damping) {
  if (!(contact.depth > 0.0)) return 0.0;
  const double contact_radius = std::sqrt(contact.contact_area / kPi);
  const double stiffness = loading_coefficient * contact_modulus * contact_radius;
  return std::max(0.0, stiffness * contact.depth + damping * contact.depth_rate);
}

double springDashpotForce(const ContactGeometry& contact, double stiffness, double damping) {
  if (!(contact.depth > 0.0)) return 0.0;
  return std::max(0.0, stiffness * contact.depth + damping * contact.depth_rate);
}

double hertzForce(double depth, double contact_modulus, double radius) {
  if (!(depth > 0.0)) return 0.0;
  return 4.0 / 3.0 * contact_modulus * std::sqrt(radius * depth) * depth;
}

double huntCrossleyForce(double depth, double depth_rate, double contact_modulus, double radius,
                         double dissipation) {
  return std::max(0.0, hertzForce(depth, contact_modulus, radius) * (1.0 + 1.5 * dissipation * depth_rate));
}

double elasticFoundationForce(double volume, double depth_rate, double foundation_stiffness,
                              double dissipation) {
  if (!(volume > 0.0)) return 0.0;
  return std::max(0.0, foundation_stiffness * volume * (1.0 + 1.5 * dissipation * depth_rate));
}

double radiusFromOverlap(const ContactGeometry& contact) {
  return contact.depth > 0.0 ? contact.contact_area / (2.0 * kPi * contact.depth) : 0.0;
}

void NormalForceSettings::validate(const std::string& where) const {
  requireAllowed(normalForceParameters(), *this, where);
}

namespace {

/// Hertz and, with a dissipation, Hunt and Crossley.
NormalForce roundContact(const ContactGeometry& contact, double contact_modulus, double radius,
                         double dissipation) {
  const double elastic = hertzForce(contact.depth, contact_modulus, radius);
  const double rate = 1.5 * dissipation;
  NormalForce result;
  result.force = dissipation > 0.0 ? huntCrossleyForce(contact.depth, contact.depth_rate, contact_modulus,
                                                       radius, dissipation)
                                   : elastic;
  result.stiffness = 1.5 * elastic / contact.depth * std::max(0.0, 1.0 + rate * contact.depth_rate);
  result.damping = rate * elastic;
  return result;
}

NormalForce quasiStatic(const ContactGeometry& contact, double contact_modulus, double loading_coefficient,
                        double damping) {
  const double contact_radius = std::sqrt(contact.contact_area / kPi);
  // The contact radius of a round body grows with the root of the depth: 3/2 of the constant part.
  return {quasiStaticForce(contact, contact_modulus, loading_coefficient, damping),
          1.5 * loading_coefficient * contact_modulus * contact_radius, damping};
}

NormalForce elasticFoundation(const ContactGeometry& contact, double foundation_stiffness,
                              double dissipation) {
  const double rate = 1.5 * dissipation;
  // dV = A dd.
  return {elasticFoundationForce(contact.volume, contact.depth_rate, foundation_stiffness, dissipation),
          foundation_stiffness * contact.contact_area * std::max(0.0, 1.0 + rate * contact.depth_rate),
          rate * foundation_stiffness * contact.volume};
}

}  // namespace

NormalForce normalForce(const NormalForceSettings& settings, const ContactMaterial& material,
                        const ContactGeometry& contact) {
  if (!(contact.depth > 0.0)) {
    if (settings.model != NormalForceModel::ElasticFoundation) return {};
    return {elasticFoundation(contact, settings.foundation_stiffness, material.dissipation).force, 0.0, 0.0};
  }
  const double radius = settings.radius > 0.0 ? settings.radius : radiusFromOverlap(contact);
  switch (settings.model) {
    case NormalForceModel::QuasiStatic:
      return quasiStatic(contact, material.contact_modulus, settings.loading_coefficient, settings.damping);
    case NormalForceModel::SpringDashpot:
      return {springDashpotForce(contact, settings.stiffness, settings.damping), settings.stiffness,
              settings.damping};
    case NormalForceModel::Hertz:
      return roundContact(contact, material.contact_modulus, radius, 0.0);
    case NormalForceModel::HuntCrossley:
      return roundContact(contact, material.contact_modulus, radius, material.dissipation);
    case NormalForceModel::ElasticFoundation:
      return elasticFoundation(contact, settings.foundation_stiffness, material.dissipation);
  }
  return {};
}

namespace {

double depthOnSpring(const ContactLoad& load, double stiffness) {
  return load.speed * std::sqrt(load.mass / stiffness) + load.force / stiffness;
}

// m v^2 / 2 = 8/15 E* sqrt(R) d^2.5 (Johnson 1985, sec. 11.4), and F = 4/3 E* sqrt(R) d^1.5.
double depthOfRoundContact(const ContactLoad& load, double contact_modulus, double radius) {
  const double modulus = contact_modulus * std::sqrt(radius);
  return std::pow(15.0 / 16.0 * load.mass * load.speed * load.speed / modulus, 0.4) +
         std::pow(0.75 * load.force / modulus, 2.0 / 3.0);
}

}  // namespace

double expectedDepth(const NormalForceSettings& settings, const ContactMaterial& material,
                     const ContactLoad& load, double size) {
  switch (settings.model) {
    case NormalForceModel::QuasiStatic:
      return depthOnSpring(load, settings.loading_coefficient * material.contact_modulus * size);
    case NormalForceModel::SpringDashpot:
      return depthOnSpring(load, settings.stiffness);
    case NormalForceModel::Hertz:
    case NormalForceModel::HuntCrossley:
      if (settings.radius > 0.0) return depthOfRoundContact(load, material.contact_modulus, settings.radius);
      // radiusFromOverlap() makes a spring of a flat face: k = 4/3 E* sqrt(A / (2 pi)).
      return std::min(depthOfRoundContact(load, material.contact_modulus, size),
                      depthOnSpring(load, 4.0 / 3.0 * std::sqrt(0.5) * material.contact_modulus * size));
    case NormalForceModel::ElasticFoundation:
      return depthOnSpring(load, settings.foundation_stiffness * kPi * size * size);
  }
  return 0.0;
}

}  // namespace concave_distance
