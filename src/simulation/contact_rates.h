#pragma once

#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/normal_force.h"

namespace concave_distance {

/// How stiff and how damped a contact is at one moment: what the step has to resolve.
struct ContactRates {
  double normal_stiffness = 0.0;      ///< N/m
  double normal_damping = 0.0;        ///< N s/m
  double tangential_stiffness = 0.0;  ///< N/m, of bristles
  double tangential_damping = 0.0;    ///< N s/m
};

/// Upper estimates from the models' derivatives. The depth that counts is the one that a step of `step`
/// seconds reaches at the present rate; of an elastic foundation the present area and volume count.
/// @param normal_force the force there now, N
ContactRates contactRates(const NormalForceSettings& normal, const FrictionSettings& friction,
                          const ContactMaterial& material, const ContactGeometry& contact,
                          double normal_force, double step);

}  // namespace concave_distance
