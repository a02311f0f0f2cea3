#pragma once

#include <Eigen/Geometry>

#include "certificate.h"
#include "round_and_mesh.h"

namespace concave_distance {

/// certifyDistance() where at least one body has a shape: for that solid, by branch and bound over the other
/// body's boxes, whose bound is the shape's tangent plane at their middle. Two shapes: roundPairDistance().
/// A mesh that lies in the solid without meeting its surface has the distance of the surfaces
/// (isRoundContained() says so). Same error. The witness names triangles of the shape's mesh that are
/// nearest to its point. Allocates nothing.
DistanceCertificate certifyRoundDistance(const BodyMesh& a, const BodyMesh& b,
                                         const Eigen::Isometry3d& a_from_b, const TrianglePair* starts,
                                         std::size_t start_count, const CertificateRequest& request);

/// The closest points near a pair of triangles; two shapes have only one such pair of points.
WitnessPair refineRoundWitness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const TrianglePair& start);

/// isContained() for such a pair.
bool isRoundContained(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

inline bool hasRound(const BodyMesh& a, const BodyMesh& b) {
  return a.shape() != nullptr || b.shape() != nullptr;
}

}  // namespace concave_distance
