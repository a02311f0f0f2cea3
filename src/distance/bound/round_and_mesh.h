#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "certificate.h"
#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/round_kernels.h"

namespace concave_distance {

/// Holds a round solid and the mesh of another body at one pose.
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

/// Holds a lowest point of the mesh and the triangle that it is on.
struct RoundMinimum {
  LowestPoint lowest;  ///< shape's frame
  TriangleIndex triangle;
};

/// Walks from a triangle over those that touch it to a local minimum of the signed distance over the mesh:
/// no triangle at the point found is lower.
RoundMinimum descendOnMesh(const RoundAndMesh& pair, TriangleIndex start);

/// Holds what findLowest() found.
struct LowestFound {
  RoundMinimum best;
  double lower_bound;  ///< of the signed distance over the whole mesh, but for roundings
  bool was_cut;        ///< the limit ended the search
};

/// Searches the whole mesh for its lowest point, by branch and bound, as far as the request's tolerances and
/// limit say. @param best where to begin @param cost is added to
LowestFound findLowest(const RoundAndMesh& pair, const CertificateRequest& request, const RoundMinimum& best,
                       CertificateCost& cost);

/// Returns the greatest signed distance of a mesh that lies wholly inside the solid, which is attained at a
/// vertex since it is convex; nothing for another mesh.
std::optional<RoundMinimum> highestIfInside(const RoundAndMesh& pair);

}  // namespace concave_distance
