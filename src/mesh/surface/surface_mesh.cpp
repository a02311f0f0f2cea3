#include "concave_distance/mesh/surface/surface_mesh.h"

#include "base/constants.h"
#include "concave_distance/base/error.h"

namespace concave_distance {

SurfaceMesh::SurfaceMesh(std::vector<Eigen::Vector3d> vertices, std::vector<TriangleNodes> triangles,
                         const std::string& where)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  if (triangles_.empty()) {
    throw Error(where, "the mesh has no triangle", "give a mesh with at least one triangle of non-zero area");
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (!vertices_[i].allFinite() || vertices_[i].cwiseAbs().maxCoeff() > kLargestCoordinate) {
      throw Error(where,
                  "vertex " + std::to_string(i) + " has a coordinate that is not finite or beyond 1e18 m",
                  "export the mesh again, or correct its scale");
    }
    bounding_box_.extend(vertices_[i]);
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const NodeIndex node : triangles_[i]) {
      if (node.value >= vertices_.size()) {
        throw Error(where,
                    "triangle " + std::to_string(i) + " refers to vertex " + std::to_string(node.value) +
                        " of " + std::to_string(vertices_.size()),
                    "export the mesh again");
      }
    }
  }
}

}  // namespace concave_distance
