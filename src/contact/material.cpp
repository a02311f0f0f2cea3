#include "concave_distance/contact/material.h"

#include <algorithm>
#include <cmath>

#include "base/parameter_checks.h"
#include "contact_parameter_tables.h"

namespace concave_distance {

void Material::validate(const std::string& where) const {
  requireAllowed(materialParameters(), *this, where);
  if (static_friction < dynamic_friction) {
    detail::refuse(where, "static_friction", detail::toText(static_friction),
                   "dynamic_friction (" + detail::toText(dynamic_friction) + ") or more, finite");
  }
}

ContactMaterial inContact(const Material& a, const Material& b) {
  const double compliance_a = (1.0 - a.poissons_ratio * a.poissons_ratio) / a.youngs_modulus;
  const double compliance_b = (1.0 - b.poissons_ratio * b.poissons_ratio) / b.youngs_modulus;
  ContactMaterial pair;
  pair.contact_modulus = 1.0 / (compliance_a + compliance_b);
  pair.dissipation = pair.contact_modulus * (compliance_a * a.dissipation + compliance_b * b.dissipation);
  pair.static_friction = std::sqrt(a.static_friction * b.static_friction);
  pair.dynamic_friction = std::sqrt(a.dynamic_friction * b.dynamic_friction);
  pair.viscous_friction = std::sqrt(a.viscous_friction * b.viscous_friction);
  pair.rolling_friction = std::max(a.rolling_friction, b.rolling_friction);
  pair.spinning_friction = std::max(a.spinning_friction, b.spinning_friction);
  return pair;
}

}  // namespace concave_distance
