#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/wrench.h"
#include "friction_sites.h"

namespace concave_distance {

/// Holds the motion of B against A, about A's origin.
struct PatchMotion {
  const RelativeTwist& b_in_a;
  const RelativeTwist& displacement;  ///< since the last call, metres and radians
  double step;                        ///< seconds since then
};

struct SiteBristles {
  std::uint64_t cell;
  Eigen::Vector3d point_in_a;
  BristleState bristles;
  double spun;  ///< metres at the site's spread: how far they are bent by spinning
};

/// Friction on B at one site, about A's origin: the chosen law of the speed sqrt(v^2 + (w s)^2), with v the
/// sliding velocity at the centre, w the angular velocity about the normal and s the spread, so that the
/// force is along v and the torque about the normal. The mean speed over the site is that to second order
/// where v is large, and where it is 0 at most 25 % more. Adds its share of the linearisation.
Wrench siteFriction(const FrictionSettings& settings, const ContactMaterial& material,
                    const FrictionSite& site, const PatchMotion& motion, SiteBristles& state,
                    ContactLinearisation& linearisation);

}  // namespace concave_distance
