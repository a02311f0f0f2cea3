#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Volume of a closed surface (m^3) and its first and second moments (m^4, m^5) about `origin`, the middle of
/// its bounding box. They are sums over the tetrahedra from there to each triangle.
struct SurfaceMoments {
  explicit SurfaceMoments(const SurfaceMesh& closed) : origin(closed.boundingBox().center()) {
    for (const TriangleNodes& triangle : closed.triangles()) {
      const Eigen::Vector3d a = closed.vertex(triangle[0]) - origin;
      const Eigen::Vector3d b = closed.vertex(triangle[1]) - origin;
      const Eigen::Vector3d c = closed.vertex(triangle[2]) - origin;
      const double part = a.dot(b.cross(c)) / 6.0;
      const Eigen::Vector3d sum = a + b + c;
      volume += part;
      first += part / 4.0 * sum;
      // A tetrahedron with a corner at the origin has V / 20 (aa' + bb' + cc' + (a + b + c)(a + b + c)').
      second +=
          part / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  }

  Eigen::Vector3d centre() const { return origin + first / volume; }

  Eigen::Vector3d origin;
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

}  // namespace concave_distance::detail
