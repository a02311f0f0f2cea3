#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::test {

inline RoundShape roundShape(RoundKind kind, double radius, double half_length = 0.0,
                             double chord_error = 0.0) {
  RoundShape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  shape.chord_error = chord_error > 0.0 ? chord_error : 0.01 * radius;
  return shape;
}

inline RoundShape sphereOf(double radius) {
  return roundShape(RoundKind::Sphere, radius);
}

inline std::shared_ptr<const BodyMesh> makeRoundBody(const RoundShape& shape, bool exact = true) {
  BodyMeshOptions options;
  if (exact) options.shape = shape;
  return std::make_shared<const BodyMesh>("round", inscribedMesh(shape, "round"), options);
}

/// Signed distance in long double, by the definition: written apart from round_geometry.h.
inline long double wideSignedDistance(const RoundShape& shape, const Eigen::Matrix<long double, 3, 1>& p) {
  const long double across = std::sqrt(p.x() * p.x() + p.y() * p.y());
  const long double beyond = std::abs(p.z()) - static_cast<long double>(shape.half_length);
  const auto radius = static_cast<long double>(shape.radius);
  if (shape.kind != RoundKind::Cylinder)
    return std::sqrt(across * across + (beyond > 0 ? beyond * beyond : 0)) - radius;
  if (across > radius && beyond > 0) return std::hypot(across - radius, beyond);
  return std::max(across - radius, beyond);
}

}  // namespace concave_distance::test
