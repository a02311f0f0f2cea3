#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Triangles of one flat patch around a node, joined over edges of two triangles that are wound alike.
struct VertexFan {
  std::uint32_t patch = 0;
  bool is_closed = false;      ///< all the way around the node
  std::vector<NodeIndex> rim;  ///< counter-clockwise; of an open fan with both ends
  std::vector<std::uint32_t> triangles;
};

/// A mesh from which nodes are taken, with the triangles at each node.
class PatchedMesh {
 public:
  PatchedMesh(const SurfaceMesh& mesh, std::vector<std::uint32_t> patch_of_triangle);

  std::size_t nodeCount() const { return triangles_of_node_.size(); }
  std::size_t degree(NodeIndex node) const { return degrees_[node.value]; }
  const TriangleNodes& triangle(std::uint32_t triangle) const { return triangles_[triangle]; }

  /// Every triangle at the node is in one of the fans.
  std::vector<VertexFan> fansOf(NodeIndex node) const;

  std::size_t trianglesAt(NodeIndex a, NodeIndex b) const;
  bool hasTriangle(const TriangleNodes& nodes) const;

  void add(const TriangleNodes& nodes, std::uint32_t patch);
  void remove(std::uint32_t triangle);

  /// Nodes without a triangle are left out.
  SurfaceMesh compacted(const std::vector<Eigen::Vector3d>& vertices) const;

 private:
  std::vector<TriangleNodes> triangles_;
  std::vector<std::uint32_t> patches_;                         ///< by triangle
  std::vector<bool> is_removed_;                               ///< by triangle
  std::vector<std::vector<std::uint32_t>> triangles_of_node_;  ///< those removed as well, until they are most
  std::vector<std::size_t> degrees_;                           ///< by node: triangles that are there
};

}  // namespace concave_distance::detail
