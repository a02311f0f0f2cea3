#pragma once

#include <Eigen/Geometry>

#include "certificate.h"
#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/round_kernels.h"

namespace concave_distance {

/// A round solid and the mesh of another body at one pose.
struct RoundAndMesh {
  /// @param mesh_from_body of the body that the shape belongs to
  RoundAndMesh(const RoundShape& round, const BodyMesh& other, const Eigen::Isometry3d& mesh_from_body);

  Eigen::Vector3d inShape(const Eigen::Vector3d& point_in_mesh) const {
    return shape_from_mesh * (point_in_mesh - centre_in_mesh);
  }
  TrianglePoints triangleInShape(TriangleIndex triangle) const;

  const RoundShape& shape;
  const BodyMesh& mesh;
  Eigen::Matrix3d shape_from_mesh;
  Eigen::Vector3d centre_in_mesh;
};

/// A lowest point of the mesh and the triangle that it is on.
struct RoundMinimum {
  LowestPoint lowest;  ///< shape's frame
  TriangleIndex triangle;
};

/// Walks from a triangle over those that touch it to a local minimum of the signed distance over the mesh:
/// no triangle at the point found is lower.
RoundMinimum descendOnMesh(const RoundAndMesh& pair, TriangleIndex start);

/// certifyDistance() where at least one body has a shape: for that solid, by branch and bound over the other
/// body's boxes, whose bound is the shape's tangent plane at their middle. Two shapes: roundPairDistance().
/// A mesh that lies in the solid without meeting its surface has the distance of the surfaces
/// (isRoundContained() says so). Same error. The witness names triangles of the shape's mesh that are
/// nearest to its point. Allocates nothing.
DistanceCertificate certifyRoundDistance(const BodyMesh& a, const BodyMesh& b,
                                         const Eigen::Isometry3d& a_from_b, const TrianglePair* seeds,
                                         std::size_t seed_count, const CertificateRequest& request);

/// The closest points near a pair of triangles; two shapes have only one such pair of points.
WitnessPair refineRoundWitness(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const TrianglePair& start);

/// isContained() for such a pair.
bool isRoundContained(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

inline bool hasRound(const BodyMesh& a, const BodyMesh& b) {
  return a.shape() != nullptr || b.shape() != nullptr;
}

}  // namespace concave_distance
