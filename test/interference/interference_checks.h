#pragma once

#include <Eigen/Geometry>

#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/body_mesh.h"
#include "support/body_pairs.h"

namespace concave_distance::test {

inline Interference interferenceOf(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  InterferenceWorkspace workspace;
  Interference result;
  findInterference(a, b, a_from_b, workspace, result);
  return result;
}

inline Interference interferenceOf(const SurfaceMesh& a, const SurfaceMesh& b,
                                   const Eigen::Isometry3d& a_from_b) {
  return interferenceOf(*makeBody(a), *makeBody(b), a_from_b);
}

/// A rotation of no special angle.
inline Eigen::Isometry3d slanted(double angle = 0.7) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
}

}  // namespace concave_distance::test
