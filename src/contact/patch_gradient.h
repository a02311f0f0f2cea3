#pragma once

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/interference/interference.h"
#include "pressure_law.h"

namespace concave_distance {

/// Says how the measures of a patch change with a small motion of B: minus their derivatives,
/// about A's origin.
struct PatchGradient {
  Vector6d push = Vector6d::Zero();  ///< integral of the depth along the push: the wrench over the stiffness
  Vector6d volume = Vector6d::Zero();  ///< m^2, m^3
  Vector6d moment = Vector6d::Zero();  ///< m^3, m^4
  Vector6d depth = Vector6d::Zero();   ///< of the greatest depth: 1 (shift), m (turn)

  void add(const OverlapSample& sample);
};

/// Adds what the change of the law's own stiffness brings. It is taken along the patch's push, where round
/// contact has all of it, and no more of a decrease than leaves the sum with the pressure's own stiffness
/// positive: by Cauchy's inequality push push^T is at most twice the moment times the integral of e e^T, e
/// the push at a place.
void addChangeOfLaw(const PressureLaw& law, const PatchGradient& gradient, double moment,
                    Matrix6d& stiffness);

}  // namespace concave_distance
