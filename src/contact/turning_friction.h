#pragma once

#include <Eigen/Core>

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/material.h"

namespace concave_distance {

/// Says where bodies roll and spin on each other.
struct TurningContact {
  Eigen::Vector3d normal_in_a;  ///< unit
  double force;                 ///< N, along the normal, > 0
  double arm;                   ///< metres: turning by an angle counts as sliding by this times the angle
};

/// Says how B turns against A, A's frame.
struct TurningMotion {
  Eigen::Vector3d rate;   ///< rad/s
  Eigen::Vector3d angle;  ///< radians, since the last call
  double step;            ///< seconds since then
};

/// Holds how far turning has bent the bristles, metres at the arm.
struct TurningBristles {
  BristleState rolling;
  BristleState spinning;
};

inline bool resistsTurning(const ContactMaterial& material) {
  return material.rolling_friction > 0.0 || material.spinning_friction > 0.0;
}

/// The torque on B, N m, against rolling (rolling_friction times the force, against what of the rate lies in
/// the tangent plane) and spinning (spinning_friction times the force, about the normal): friction of the
/// chosen model at the arm, with the coefficient that makes the torque, static as dynamic. So bristles stick
/// with the stiffness N sigma_0 arm^2 (Iwashita and Oda 1998), and a ball whose radius is the arm comes to
/// rest on a slope as a block does. Adds its share of the linearisation.
Eigen::Vector3d resistTurning(const FrictionSettings& settings, const ContactMaterial& material,
                              const TurningContact& contact, const TurningMotion& motion,
                              TurningBristles& bristles, ContactLinearisation& linearisation);

}  // namespace concave_distance
