#include "contact_rates.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

constexpr double kPi = 3.14159265358979323846;
// The stiffness of a round contact grows with the root of its depth; deeper than this at once, and what
// limits the step is the penetration allowed.
constexpr double kLargestGrowth = 10.0;

double growthOfRoot(double depth, double deeper) {
  return std::min(kLargestGrowth, std::sqrt(deeper / depth));
}

}  // namespace

ContactRates contactRates(const NormalForceSettings& normal, const FrictionSettings& friction,
                          const ContactMaterial& material, const ContactGeometry& contact,
                          double normal_force, double step) {
  ContactRates rates;
  if (!(contact.depth > 0.0)) return rates;
  const double deeper = contact.depth + step * std::max(0.0, contact.depth_rate);
  const double growth = growthOfRoot(contact.depth, deeper);
  switch (normal.model) {
    case NormalForceModel::QuasiStatic: {
      const double contact_radius = std::sqrt(contact.contact_area / kPi);
      // The contact radius of a round body grows with the root of the depth: 3/2 of the constant part.
      rates.normal_stiffness =
          1.5 * normal.loading_coefficient * material.contact_modulus * contact_radius * growth;
      rates.normal_damping = normal.damping;
      break;
    }
    case NormalForceModel::SpringDashpot:
      rates.normal_stiffness = normal.stiffness;
      rates.normal_damping = normal.damping;
      break;
    case NormalForceModel::Hertz:
    case NormalForceModel::HuntCrossley: {
      const double radius = normal.radius > 0.0 ? normal.radius : radiusFromOverlap(contact);
      const double elastic = 2.0 * material.contact_modulus * std::sqrt(radius * contact.depth) * growth;
      const double rate = normal.model == NormalForceModel::HuntCrossley ? 1.5 * material.dissipation : 0.0;
      rates.normal_stiffness = elastic * std::max(0.0, 1.0 + rate * contact.depth_rate);
      rates.normal_damping = rate * elastic / 1.5 * deeper;  // the elastic force is 2/3 of elastic * depth
      break;
    }
    case NormalForceModel::ElasticFoundation: {
      // dV = A dd.
      const double rate = 1.5 * material.dissipation;
      rates.normal_stiffness =
          normal.foundation_stiffness * contact.contact_area * std::max(0.0, 1.0 + rate * contact.depth_rate);
      rates.normal_damping = rate * normal.foundation_stiffness * contact.volume;
      break;
    }
  }
  switch (friction.model) {
    case FrictionModel::None:
      break;
    case FrictionModel::RegularisedCoulomb:
      rates.tangential_damping =
          (material.static_friction / friction.regularisation_speed + material.viscous_friction) *
          normal_force;
      break;
    case FrictionModel::Bristle:
      rates.tangential_stiffness = friction.bristle_stiffness * normal_force;
      rates.tangential_damping = (friction.bristle_damping + material.viscous_friction) * normal_force;
      break;
  }
  return rates;
}

}  // namespace concave_distance
