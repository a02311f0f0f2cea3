#pragma once

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

}  // namespace concave_distance
