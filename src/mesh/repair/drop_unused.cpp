#include "drop_unused.h"

namespace concave_distance::detail {

std::size_t dropUnused(std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles) {
  std::vector<bool> used(vertices.size(), false);
  for (const TriangleNodes& nodes : triangles) {
    for (const NodeIndex node : nodes) {
      used[node.value] = true;
    }
  }
  std::vector<NodeIndex> renumbered(vertices.size());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (used[v]) {
      renumbered[v] = NodeIndex{kept};
      vertices[kept++] = vertices[v];
    }
  }
  for (TriangleNodes& nodes : triangles) {
    for (NodeIndex& node : nodes) {
      node = renumbered[node.value];
    }
  }
  const std::size_t dropped = vertices.size() - kept;
  vertices.resize(kept);
  return dropped;
}

}  // namespace concave_distance::detail
