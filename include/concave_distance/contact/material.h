#pragma once

#include <string>

namespace concave_distance {

/// Says what a body is made of, as far as contact forces need it. The defaults are a hard plastic.
struct Material {
  double youngs_modulus = 2.5e9;  ///< E, pascal, > 0
  double poissons_ratio = 0.35;   ///< nu, from 0 to below 0.5
  double dissipation = 0.1;       ///< c of Hunt and Crossley, s/m, >= 0; about (1 - e) / v at small speeds v
  double static_friction = 0.5;   ///< coefficient at rest, >= dynamic_friction
  double dynamic_friction = 0.4;  ///< coefficient while sliding, >= 0
  double viscous_friction = 0.0;  ///< s/m: what the coefficient grows by with the sliding speed, >= 0
  /// Torque over normal force against rolling, and against spinning about the normal beside what friction all
  /// over the contact does, metres, >= 0.
  double rolling_friction = 0.0;
  double spinning_friction = 0.0;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

struct ContactMaterial {
  /// E* = 1 / ((1 - nu1^2) / E1 + (1 - nu2^2) / E2), pascal: the fraction of, written
  /// E1 E2 / (E1 (1 - nu2^2) + E2 (1 - nu1^2)) there.
  double contact_modulus;
  /// Each body's, by the share of the deformation that it takes (its compliance over the sum); s/m.
  double dissipation;
  /// Geometric means; 0 where either body is frictionless.
  double static_friction;
  double dynamic_friction;
  double viscous_friction;
  /// The larger ones, as MuJoCo does: a steel ball is held back by the carpet it rolls on. (Bullet: each
  /// body's times the other's sliding coefficient, added up.)
  double rolling_friction = 0.0;
  double spinning_friction = 0.0;
  /// Bristles that are bent by less than this share of their largest deflection do not slip.
  double breakaway = 0.7;
};

ContactMaterial inContact(const Material& a, const Material& b);

}  // namespace concave_distance
