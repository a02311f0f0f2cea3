#include "concave_distance/mesh/surface/mass_properties.h"

#include <Eigen/Eigenvalues>

#include "base/parameter_checks.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

// Tensors from files are rounded: this much asymmetry, or excess over the triangle inequality, is let pass.
constexpr double kTensorTolerance = 1e-6;

// About the middle of the bounding box: volume, its first moment and its second moments.
struct Moments {
  Eigen::Vector3d origin;
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

Moments momentsOf(const SurfaceMesh& mesh) {
  Moments moments;
  moments.origin = mesh.boundingBox().center();
  for (const TriangleNodes& triangle : mesh.triangles()) {
    const Eigen::Vector3d a = mesh.vertex(triangle[0]) - moments.origin;
    const Eigen::Vector3d b = mesh.vertex(triangle[1]) - moments.origin;
    const Eigen::Vector3d c = mesh.vertex(triangle[2]) - moments.origin;
    const double volume = a.dot(b.cross(c)) / 6.0;
    const Eigen::Vector3d sum = a + b + c;
    moments.volume += volume;
    moments.first += volume / 4.0 * sum;
    // Of a tetrahedron with a corner at the origin: V / 20 (aa' + bb' + cc' + (a + b + c)(a + b + c)').
    moments.second +=
        volume / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  return moments;
}

MassProperties evenlyFilled(const Moments& moments, double density) {
  MassProperties properties;
  properties.mass = density * moments.volume;
  const Eigen::Vector3d centre = moments.first / moments.volume;
  properties.centre_in_body = moments.origin + centre;
  const Eigen::Matrix3d covariance =
      density * (moments.second - moments.volume * centre * centre.transpose());
  properties.inertia = covariance.trace() * Eigen::Matrix3d::Identity() - covariance;
  return properties;
}

Moments requireVolume(const SurfaceMesh& closed, const std::string& where) {
  Moments moments = momentsOf(closed);
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
  const Moments moments = requireVolume(closed, where);
  return evenlyFilled(moments, mass / moments.volume);
}

}  // namespace concave_distance
