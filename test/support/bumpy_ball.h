#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::test {

/// A ball with bumps, around the origin: many pairs of places of two of them may face each other.
/// @param sag metres, as for makeSphere()
/// @param waves radians of the bumps over a radius
inline SurfaceMesh makeBumpyBall(double radius, double sag, double waves) {
  const SurfaceMesh ball = makeSphere(radius, sag);
  std::vector<Eigen::Vector3d> vertices;
  for (std::uint32_t k = 0; k < ball.vertexCount(); ++k) {
    const Eigen::Vector3d& v = ball.vertex(NodeIndex{k});
    const Eigen::Vector3d w = waves / radius * v;
    vertices.emplace_back((1.0 + 0.12 * std::sin(w.x()) * std::cos(w.y()) * std::sin(w.z() + 1.0)) * v);
  }
  return SurfaceMesh(std::move(vertices), ball.triangles(), "bumpy ball");
}

}  // namespace concave_distance::test
