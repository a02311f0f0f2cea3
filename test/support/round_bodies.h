#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/body_mesh.h"
#include "support/body_pairs.h"

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

inline Interference overlapOf(const std::shared_ptr<const BodyMesh>& a,
                              const std::shared_ptr<const BodyMesh>& b, const Eigen::Isometry3d& pose) {
  InterferenceWorkspace workspace;
  Interference result;
  findInterference(*a, *b, pose, workspace, result);
  return result;
}

/// Upper face at z = 0.
inline const std::shared_ptr<const BodyMesh>& block() {
  static const std::shared_ptr<const BodyMesh> kBlock = [] {
    const SurfaceMesh box = makeBox({4.0, 4.0, 4.0});
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : box.vertices())
      vertices.push_back(vertex - Eigen::Vector3d(0.3, 0.1, 2.0));
    return makeBody(SurfaceMesh(vertices, box.triangles(), "block"));
  }();
  return kBlock;
}

/// Integral of a power of the depth over the samples.
inline double sumOf(const Interference& result, const InterferenceRegion& region, int power) {
  double sum = 0.0;
  for (std::uint32_t s = 0; s < region.sample_count; ++s) {
    const OverlapSample& sample = result.samples[region.first_sample + s];
    sum += sample.area * std::pow(sample.depth, power);
  }
  return sum;
}

}  // namespace concave_distance::test
