#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "concave_distance/contact/material.h"

namespace concave_distance {

/// Names the laws by which the force along the normal follows from an interference region. All are in
/// newtons, push only (a force that would pull is 0: bodies in contact do not stick to each other), and are
/// right for any depth >= 0.
enum class NormalForceModel : std::uint8_t {
  QuasiStatic,       ///< Carretero, eq. (A-1) and (A-2)
  SpringDashpot,     ///< constant stiffness and damping
  Hertz,             ///< elastic, no damping
  HuntCrossley,      ///< Hertz with non-linear damping
  ElasticFoundation  ///< pressure in proportion to the depth at every place of the contact
};
std::string_view toString(NormalForceModel model);

/// Says where the force of a region acts.
enum class ForceDistribution : std::uint8_t {
  Pressure,  ///< all over the surfaces of the overlap, in proportion to how deep they lie
  Lumped     ///< at the centroid, along one normal: for one convex place
};
std::string_view toString(ForceDistribution distribution);

/// Holds what a force depends on of one interference region.
struct ContactGeometry {
  double depth = 0.0;         ///< d, metres, >= 0
  double depth_rate = 0.0;    ///< metres a second, positive while the bodies go deeper
  double contact_area = 0.0;  ///< A, square metres: the area of the region's loops seen along the normal
  double volume = 0.0;        ///< V, cubic metres: of the overlap
};

/// c of with which a = sqrt(A / pi) of the GEOMETRIC overlap gives Hertz's force: there a^2 = 2 R d,
/// where elastic spheres touch over a^2 = R d.
inline constexpr double kHertzLoadingCoefficient = 0.94280904158206336587;  // 4 / (3 sqrt 2)

/// without friction: (k_c d + mu_d d') n with k_c = c E* a, a = sqrt(A / pi).
/// @param loading_coefficient c, of the surface's load, without a unit
/// @param damping mu_d, newton second a metre
double quasiStaticForce(const ContactGeometry& contact, double contact_modulus, double loading_coefficient,
                        double damping);

/// k d + b d'. @param stiffness k, newton a metre @param damping b, newton second a metre
double springDashpotForce(const ContactGeometry& contact, double stiffness, double damping);

/// 4/3 E* sqrt(R) d^(3/2) (Johnson 1985, eq. (4.23)). @param radius R = 1 / (1/R1 + 1/R2), metres
double hertzForce(double depth, double contact_modulus, double radius);

/// Hertz times (1 + 3/2 c d') (Hunt and Crossley 1975; Marhefka and Orin 1996).
/// @param dissipation c, seconds a metre
double huntCrossleyForce(double depth, double depth_rate, double contact_modulus, double radius,
                         double dissipation);

/// k_f V (1 + 3/2 c d'): a bed of springs side by side (Johnson 1985, sec. 4.3, after Winkler), whose
/// pressure k_f times the depth adds up to the volume of the overlap and acts at its centroid, which is where
/// a region's force acts. Of flat faces that rock on each other it is the one law here that has a potential:
/// the others count with the greatest depth alone, and their force at the centroid may do work in a cycle.
/// @param foundation_stiffness k_f, pascal a metre @param dissipation c, seconds a metre
double elasticFoundationForce(double volume, double depth_rate, double foundation_stiffness,
                              double dissipation);

/// The relative radius of curvature that a region of this area and depth has where a sphere dips into a
/// plane: A = 2 pi R d at small depths. 0 without depth.
double radiusFromOverlap(const ContactGeometry& contact);

struct NormalForceSettings {
  NormalForceModel model = NormalForceModel::HuntCrossley;
  ForceDistribution distribution = ForceDistribution::Pressure;
  double loading_coefficient = kHertzLoadingCoefficient;  ///< quasi_static, > 0
  double stiffness = 1e5;                                 ///< spring_dashpot, N/m, > 0
  double damping = 0.0;                                   ///< quasi_static and spring_dashpot, N s/m, >= 0
  double foundation_stiffness = 1e9;                      ///< elastic_foundation, Pa/m, > 0
  /// hertz and hunt_crossley: R, metres; 0: from the overlap (radiusFromOverlap), each region its own.
  double radius = 0.0;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

inline bool operator==(const NormalForceSettings& l, const NormalForceSettings& r) {
  return std::tie(l.model, l.distribution, l.loading_coefficient, l.stiffness, l.damping,
                  l.foundation_stiffness, l.radius) == std::tie(r.model, r.distribution,
                                                                r.loading_coefficient, r.stiffness, r.damping,
                                                                r.foundation_stiffness, r.radius);
}

/// A model's force with its derivatives.
struct NormalForce {
  double force = 0.0;      ///< N, >= 0
  double stiffness = 0.0;  ///< by the depth, N/m, >= 0; of an elastic foundation with the area as it is
  double damping = 0.0;    ///< by the depth's rate, N s/m, >= 0
};

/// The chosen model.
NormalForce normalForce(const NormalForceSettings& settings, const ContactMaterial& material,
                        const ContactGeometry& contact);

/// Says what hits or presses on a contact.
struct ContactLoad {
  double mass = 0.0;   ///< reduced, of both bodies, kg
  double speed = 0.0;  ///< of the bodies against each other, m/s
  double force = 0.0;  ///< that presses them together, N
};

/// A lower estimate of the depth that a contact of this law reaches, metres: of an undamped impact at this
/// speed and under this force, each alone, added up. @param size of the smaller body, metres: no contact has
/// a larger radius
double expectedDepth(const NormalForceSettings& settings, const ContactMaterial& material,
                     const ContactLoad& load, double size);

}  // namespace concave_distance
