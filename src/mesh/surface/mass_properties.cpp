#include "concave_distance/mesh/surface/mass_properties.h"

#include <Eigen/Eigenvalues>

#include "base/parameter_checks.h"
#include "concave_distance/base/error.h"
#include "surface_moments.h"

namespace concave_distance {
namespace {

using detail::SurfaceMoments;

// Tensors from files are rounded: this much asymmetry, or excess over the triangle inequality, is let pass.
constexpr double kTensorTolerance = 1e-6;

MassProperties evenlyFilled(const SurfaceMoments& moments, double density) {
  MassProperties properties;
  properties.mass = density * moments.volume;
  const Eigen::Vector3d centre = moments.first / moments.volume;
  properties.centre_in_body = moments.origin + centre;
  const Eigen::Matrix3d covariance =
      density * (moments.second - moments.volume * centre * centre.transpose());
  properties.inertia = covariance.trace() * Eigen::Matrix3d::Identity() - covariance;
  return properties;
}

SurfaceMoments requireVolume(const SurfaceMesh& closed, const std::string& where) {
  const SurfaceMoments moments(closed);
  if (!(moments.volume > 0.0)) {
    throw Error(where, "the surface encloses a volume of " + detail::toText(moments.volume) + " m^3",
                "a closed surface with its triangles outward is needed, or give the inertia");
  }
  return moments;
}

}  // namespace

void MassProperties::validate(const std::string& where) const {
  detail::requirePositive(where, "mass", mass, "kg");
  if (!centre_in_body.allFinite()) detail::refuse(where, "centre", "not finite", "three finite numbers");
  const double size = inertia.norm();
  const bool symmetric =
      inertia.allFinite() && (inertia - inertia.transpose()).norm() <= kTensorTolerance * size;
  const char* allowed =
      "a symmetric positive tensor, none of whose principal moments exceeds the sum of the others, kg m^2";
  if (!symmetric) detail::refuse(where, "tensor", "not symmetric or not finite", allowed);
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  if (!(moments[0] > 0.0) || moments[2] > (moments[0] + moments[1]) * (1.0 + kTensorTolerance)) {
    detail::refuse(where, "tensor",
                   "one with the principal moments " + detail::toText(moments[0]) + ", " +
                       detail::toText(moments[1]) + ", " + detail::toText(moments[2]),
                   allowed);
  }
}

MassProperties massPropertiesOf(const SurfaceMesh& closed, double density, const std::string& where) {
  detail::requirePositive(where, "density", density, "kg/m^3");
  return evenlyFilled(requireVolume(closed, where), density);
}

MassProperties massPropertiesOfMass(const SurfaceMesh& closed, double mass, const std::string& where) {
  detail::requirePositive(where, "mass", mass, "kg");
  const SurfaceMoments moments = requireVolume(closed, where);
  return evenlyFilled(moments, mass / moments.volume);
}

}  // namespace concave_distance
