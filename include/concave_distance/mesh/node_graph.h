#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/compressed_rows.h"
#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance {

/// The search's view of a surface (Carretero, sec. 3.1): nodes and the mesh edges between them.
struct NodeGraph {
  struct Edge {
    NodeIndex to;
    float length;  ///< metres, rounded to nearest from double; used by the mesh metric only
  };
  std::vector<Eigen::Vector3d> positions;  ///< body frame, metres
  CompressedRows<Edge> edges;              ///< the adjacency Pi, ascending by node
  std::vector<std::uint32_t> shell;        ///< connected component of each node
  std::uint32_t shell_count = 0;

  std::size_t nodeCount() const { return positions.size(); }
};

/// Nodes that no triangle uses are left without edges and form shells of their own. O(n log n).
NodeGraph buildNodeGraph(const SurfaceMesh& grid);

}  // namespace concave_distance
