#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "witness_refinement.h"

namespace concave_distance::detail {

inline TrianglePoints localCorners(const SurfaceMesh& mesh, TriangleIndex triangle,
                                   const Eigen::Vector3d& centre) {
  return {mesh.corner(triangle, 0) - centre, mesh.corner(triangle, 1) - centre,
          mesh.corner(triangle, 2) - centre};
}

/// Both bodies in one recentred frame: A's coordinates relative to a point of A, B's relative to a point of B
/// and turned into A's axes. What is lost to rounding is relative to the geometry at hand and, once for the
/// two bodies as a whole, to the translation that came in.
struct LocalFrames {
  LocalFrames(const Eigen::Vector3d& centre_in_a, const Eigen::Vector3d& centre_in_b,
              const Eigen::Isometry3d& a_from_b)
      : centre_a(centre_in_a),
        centre_b(centre_in_b),
        rotation(a_from_b.linear()),
        offset(a_from_b * centre_in_b - centre_in_a) {}

  /// Centred at the first corners of two triangles.
  LocalFrames(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
              TriangleIndex triangle_a, TriangleIndex triangle_b)
      : LocalFrames(a.surface().corner(triangle_a, 0), b.surface().corner(triangle_b, 0), a_from_b) {}

  TrianglePoints cornersOfA(const BodyMesh& a, TriangleIndex t) const {
    return localCorners(a.surface(), t, centre_a);
  }
  TrianglePoints cornersOfB(const BodyMesh& b, TriangleIndex t) const {
    const TrianglePoints in_b = localCorners(b.surface(), t, centre_b);
    return {rotation * in_b[0] + offset, rotation * in_b[1] + offset, rotation * in_b[2] + offset};
  }
  /// From local coordinates to B's axes, relative to centre_b.
  Eigen::Vector3d pointInB(const Eigen::Vector3d& point) const {
    return rotation.transpose() * (point - offset);
  }
  WitnessPair toWitness(const TrianglePairDistance& local, TriangleIndex triangle_a,
                        TriangleIndex triangle_b) const {
    return {
        local.squared_distance, local.point_a + centre_a, local.point_b + centre_a, triangle_a, triangle_b,
        local.feature_a,        local.feature_b};
  }

  Eigen::Vector3d centre_a;
  Eigen::Vector3d centre_b;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d offset;
};

/// Largest magnitude of a coordinate: what the kernel's error bounds are relative to.
inline double largestMagnitude(const TrianglePoints& a, const TrianglePoints& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max({largest, a[k].cwiseAbs().maxCoeff(), b[k].cwiseAbs().maxCoeff()});
  }
  return largest;
}

}  // namespace concave_distance::detail
