#include "concave_distance/mesh/surface/round_shape.h"

#include <utility>

#include "base/constants.h"
#include "base/parameter_checks.h"
#include "concave_distance/mesh/surface/mass_properties.h"
#include "primitive_table.h"
#include "round_geometry.h"

namespace concave_distance {
namespace {

// The rotation's columns may be this far from orthonormal ones.
constexpr double kRigid = 1e-12;

void requireShort(const std::string& where, const char* name, double length) {
  detail::requirePositive(where, name, length, "m");
  if (length > 0.5 * kLargestCoordinate)
    detail::refuse(where, name, detail::toText(length), "a positive length of at most 5e17 m");
}

}  // namespace

void RoundShape::validate(const std::string& where) const {
  requireShort(where, "radius", radius);
  requireShort(where, "chord_error", chord_error);
  if (detail::traitsOf(kind).has_side) {
    requireShort(where, "half_length", half_length);
  } else if (half_length != 0.0) {
    detail::refuse(where, "half_length", detail::toText(half_length), "0 for a sphere");
  }
  const Eigen::Matrix3d rotation = body_from_shape.linear();
  const bool rigid =
      body_from_shape.matrix().allFinite() && rotation.determinant() > 0.0 &&
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRigid &&
      body_from_shape.translation().cwiseAbs().maxCoeff() <= kLargestCoordinate;
  if (!rigid) detail::refuse(where, "body_from_shape", "not a rigid pose", "a rotation and a translation");
}

SurfaceMesh inscribedMesh(const RoundShape& shape, const std::string& where) {
  shape.validate(where);
  const std::vector<double> dimensions{shape.radius, 2.0 * shape.half_length};
  const SurfaceMesh mesh = detail::primitiveOf(shape.kind).make(dimensions, shape.chord_error, where);
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(mesh.vertexCount());
  for (const Eigen::Vector3d& vertex : mesh.vertices()) vertices.push_back(shape.body_from_shape * vertex);
  return SurfaceMesh(std::move(vertices), mesh.triangles(), where);
}

Eigen::AlignedBox3d boundingBox(const RoundShape& shape) {
  const Eigen::Vector3d axis = shape.body_from_shape.linear().col(2);
  Eigen::Vector3d half = shape.half_length * axis.cwiseAbs();
  if (detail::hasFlatEnds(shape)) {
    half += shape.radius * (Eigen::Vector3d::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  } else {
    half += Eigen::Vector3d::Constant(shape.radius);
  }
  const Eigen::Vector3d centre = shape.body_from_shape.translation();
  return {centre - half, centre + half};
}

double volumeOf(const RoundShape& shape) {
  const double disc = kPi * shape.radius * shape.radius;
  const double ends = detail::hasFlatEnds(shape) ? 0.0 : 4.0 / 3.0 * disc * shape.radius;
  return ends + 2.0 * shape.half_length * disc;
}

MassProperties massPropertiesOf(const RoundShape& shape, double density, const std::string& where) {
  detail::requirePositive(where, "density", density, "kg/m^3");
  return massPropertiesOfMass(shape, density * volumeOf(shape), where);
}

MassProperties massPropertiesOfMass(const RoundShape& shape, double mass, const std::string& where) {
  detail::requirePositive(where, "mass", mass, "kg");
  const double r = shape.radius;
  const double h = shape.half_length;
  const bool has_ends = !detail::hasFlatEnds(shape);
  // Both ends together are a ball, 4/3 r of the disc's area; the middle is 2 h of it.
  const double ends = has_ends ? mass * (4.0 / 3.0 * r) / (4.0 / 3.0 * r + 2.0 * h) : 0.0;
  const double middle = mass - ends;
  const double along = 0.5 * middle * r * r + 0.4 * ends * r * r;
  // A half ball's centre is 3/8 r from its face: its moments by the parallel axes.
  const double across = middle * (0.25 * r * r + h * h / 3.0) + ends * (0.4 * r * r + h * h + 0.75 * r * h);
  const Eigen::Matrix3d turn = shape.body_from_shape.linear();
  MassProperties properties;
  properties.mass = mass;
  properties.centre_in_body = shape.body_from_shape.translation();
  properties.inertia = turn * Eigen::Vector3d(across, across, along).asDiagonal() * turn.transpose();
  properties.inertia = (0.5 * (properties.inertia + properties.inertia.transpose())).eval();
  return properties;
}

}  // namespace concave_distance
