#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/surface/surface_mesh.h"

/// The error bound of a whole query that doc/numerics.md states and derives.
namespace concave_distance::test {

/// Of what the kernels see: coordinates relative to a corner of A, hence the sizes and the distance.
inline constexpr double kQueryLocalError = 0x1.0p-46;
/// Of what the pose loses in double precision, relative to how far from their frames' origins the bodies are.
inline constexpr double kQueryPoseError = 0x1.0p-48;

/// Largest distance of a point of the surface's bounding box from the origin of its frame, metres.
inline double reachOf(const SurfaceMesh& mesh) {
  const Eigen::AlignedBox3d& box = mesh.boundingBox();
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
}

inline double localScale(const SurfaceMesh& a, const SurfaceMesh& b, double distance) {
  return a.diameter() + b.diameter() + distance;
}

inline double poseScale(const SurfaceMesh& a, const SurfaceMesh& b, const Eigen::Vector3d& translation) {
  return reachOf(a) + reachOf(b) + translation.norm();
}

/// |reported distance - true distance| is at most this wherever the query has found the right basin, metres.
inline double queryBound(const SurfaceMesh& a, const SurfaceMesh& b, const Eigen::Vector3d& translation,
                         double distance) {
  return kQueryLocalError * localScale(a, b, distance) + kQueryPoseError * poseScale(a, b, translation);
}

}  // namespace concave_distance::test
