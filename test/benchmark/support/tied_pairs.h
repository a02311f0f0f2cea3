#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "distance/bound/certificate.h"

namespace concave_distance::benchmark {

/// Every pair of triangles that is no farther apart than `distance` (metres): by a plain descent of both
/// bodies' triangle trees, apart from the proof that it is held against.
std::vector<TrianglePair> pairsWithin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                      double distance);

/// What any proof that measures triangle pairs one by one cannot do without: those that are as near as the
/// minimum, up to the proof's error, at the triangle kernel's time each.
struct ProofLimit {
  double ties;          ///< pairs
  double microseconds;  ///< ties times the kernel's time
};

/// @param distance of the surfaces, metres
ProofLimit proofLimit(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      double distance);

}  // namespace concave_distance::benchmark
