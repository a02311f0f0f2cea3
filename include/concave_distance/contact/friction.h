#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "concave_distance/contact/material.h"

namespace concave_distance {

enum class FrictionModel : std::uint8_t {
  None,
  RegularisedCoulomb,  ///< without a state: creeps where it should stick
  Bristle              ///< LuGre: a state per region, sticks
};
std::string_view toString(FrictionModel model);

struct FrictionSettings {
  FrictionModel model = FrictionModel::None;
  /// regularised_coulomb: below about this sliding speed the force goes to 0, m/s, > 0. A body that should
  /// stick creeps at up to this speed.
  double regularisation_speed = 1e-3;
  double stribeck_speed = 1e-2;    ///< where the coefficient has fallen from static towards dynamic, m/s, > 0
  double bristle_stiffness = 1e4;  ///< sigma_0: friction over normal force, per metre of bristle, 1/m, > 0
  double bristle_damping = 50.0;   ///< sigma_1, s/m, >= 0

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

inline bool operator==(const FrictionSettings& l, const FrictionSettings& r) {
  return std::tie(l.model, l.regularisation_speed, l.stribeck_speed, l.bristle_stiffness,
                  l.bristle_damping) ==
         std::tie(r.model, r.regularisation_speed, r.stribeck_speed, r.bristle_stiffness, r.bristle_damping);
}

/// Coefficient at a sliding speed (m/s, >= 0): mu_d + (mu_s - mu_d) exp(-(v / v_s)^2) (Stribeck). The viscous
/// part comes on top.
double frictionCoefficient(const ContactMaterial& material, double stribeck_speed, double speed);

/// Friction on B, newtons, against its sliding velocity: (mu(v) + mu_v v) N v / sqrt(v^2 + v_r^2).
/// @param sliding velocity of B relative to A in the tangent plane, m/s, any frame, the result's
Eigen::Vector3d regularisedCoulombForce(const FrictionSettings& settings, const ContactMaterial& material,
                                        double normal_force, const Eigen::Vector3d& sliding);

/// Deflection of the bristles between two surfaces, in the tangent plane, metres, in A's frame.
struct BristleState {
  Eigen::Vector3d deflection = Eigen::Vector3d::Zero();
};

/// LuGre (Canudas de Wit, Olsson, Astrom, Lischinsky 1995), per unit of normal force:
/// z' = v - alpha sigma_0 |v| z / g(v), F = -N (sigma_0 z + sigma_1 z' + mu_v v), g the Stribeck coefficient;
/// alpha is 0 while the bristles are bent to less than `breakaway` of their limit, so that nothing creeps
/// under a load that swings (Dupont, Hayward, Armstrong, Altpeter 2002). The state goes on with the implicit
/// rule z = (z + s) / (1 + sigma_0 |s| / g), s the displacement since the last call, which is stable for
/// every step. It is first turned into the plane that `normal` is perpendicular to; a force above the
/// friction cone of mu_s N is cut to it. Without load the bristles stand up again.
/// @param sliding velocity of B relative to A in the tangent plane, A's frame, m/s
/// @param displacement of B against A in the tangent plane since the last call, A's frame, metres
Eigen::Vector3d bristleForce(const FrictionSettings& settings, const ContactMaterial& material,
                             double normal_force, const Eigen::Vector3d& normal,
                             const Eigen::Vector3d& sliding, const Eigen::Vector3d& displacement,
                             BristleState& state);

/// The force of the chosen model; see bristleForce. Newtons, on B.
Eigen::Vector3d frictionForce(const FrictionSettings& settings, const ContactMaterial& material,
                              double normal_force, const Eigen::Vector3d& normal,
                              const Eigen::Vector3d& sliding, const Eigen::Vector3d& displacement,
                              BristleState& state);

struct RecentSliding {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< in the tangent plane, A's frame, metres
  double step = 0.0;                                       ///< seconds
  BristleState bristles;                                   ///< at its end
};

/// Says how friction changes with a small motion, in two directions of the tangent plane.
struct FrictionTangent {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit, where they slide, or any direction of the plane
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  ///< unit, perpendicular to it
  double stiffness_along = 0.0;                      ///< N/m, >= 0
  double stiffness_across = 0.0;                     ///< N/m, >= 0
  double damping_along = 0.0;                        ///< N s/m, >= 0
  double damping_across = 0.0;                       ///< N s/m, >= 0
};

/// The derivatives of frictionForce() at the end of a step, symmetric parts that are not negative: those of
/// the coefficient by the sliding speed are left out. Bristles that are about to turn back count as sticking.
FrictionTangent frictionTangent(const FrictionSettings& settings, const ContactMaterial& material,
                                double normal_force, const Eigen::Vector3d& normal,
                                const Eigen::Vector3d& sliding, const RecentSliding& recent);

}  // namespace concave_distance
