#pragma once

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/friction.h"

namespace concave_distance {

/// Bristles bent as before, in the plane across `normal`: turned and not projected, so that where a body
/// rolls they keep their length.
Eigen::Vector3d turnedInto(const Eigen::Vector3d& normal, const Eigen::Vector3d& deflection);

/// frictionForce() in any Cartesian coordinates, all of which are sliding.
Eigen::Vector3d frictionAlong(const FrictionSettings& settings, const ContactMaterial& material,
                              double normal_force, const Eigen::Vector3d& sliding,
                              const Eigen::Vector3d& displacement, BristleState& state);

/// The coefficients of frictionTangent(), without its directions.
FrictionTangent frictionSlopes(const FrictionSettings& settings, const ContactMaterial& material,
                               double normal_force, const Eigen::Vector3d& sliding,
                               const RecentSliding& recent);

/// Adds friction at `point`; as addDirection(), to the upper triangles alone.
inline void addFriction(const FrictionTangent& tangent, const Eigen::Vector3d& point,
                        ContactLinearisation& linearisation) {
  addDirection(tangent.stiffness_along, tangent.along, point, linearisation.stiffness);
  addDirection(tangent.stiffness_across, tangent.across, point, linearisation.stiffness);
  addDirection(tangent.damping_along, tangent.along, point, linearisation.damping);
  addDirection(tangent.damping_across, tangent.across, point, linearisation.damping);
}

/// Adds friction that acts as torques about the two directions, on an arm whose square is given.
inline void addTorsionalFriction(const FrictionTangent& tangent, double squared_arm,
                                 ContactLinearisation& linearisation) {
  addAxis(squared_arm * tangent.stiffness_along, tangent.along, linearisation.stiffness);
  addAxis(squared_arm * tangent.stiffness_across, tangent.across, linearisation.stiffness);
  addAxis(squared_arm * tangent.damping_along, tangent.along, linearisation.damping);
  addAxis(squared_arm * tangent.damping_across, tangent.across, linearisation.damping);
}

}  // namespace concave_distance
