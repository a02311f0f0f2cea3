#include "concave_distance/contact/normal_force.h"

#include <algorithm>
#include <cmath>

#include "contact_parameter_tables.h"

namespace concave_distance {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

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

double normalForce(const NormalForceSettings& settings, const ContactMaterial& material,
                   const ContactGeometry& contact) {
  const double radius = settings.radius > 0.0 ? settings.radius : radiusFromOverlap(contact);
  switch (settings.model) {
    case NormalForceModel::QuasiStatic:
      return quasiStaticForce(contact, material.contact_modulus, settings.loading_coefficient,
                              settings.damping);
    case NormalForceModel::SpringDashpot:
      return springDashpotForce(contact, settings.stiffness, settings.damping);
    case NormalForceModel::Hertz:
      return hertzForce(contact.depth, material.contact_modulus, radius);
    case NormalForceModel::HuntCrossley:
      return huntCrossleyForce(contact.depth, contact.depth_rate, material.contact_modulus, radius,
                               material.dissipation);
    case NormalForceModel::ElasticFoundation:
      return elasticFoundationForce(contact.volume, contact.depth_rate, settings.foundation_stiffness,
                                    material.dissipation);
  }
  return 0.0;
}

}  // namespace concave_distance
