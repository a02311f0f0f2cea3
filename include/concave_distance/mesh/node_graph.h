#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/compressed_rows.h"
#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance {

/// The search's view of a surface (Carretero, sec. 3.1): nodes and the mesh edges between them.
struct NodeGraph {
  struct Edge {
    NodeIndex to;
    /// Metres; used by the mesh metric only. Rounded up to a float that is a multiple of `length_quantum`,
    /// so never below the straight distance, and sums along any path are exact in double.
    float length;
  };
  std::vector<Eigen::Vector3d> positions;  ///< body frame, metres
  CompressedRows<Edge> edges;              ///< the adjacency Pi, ascending by node
  /// Entry k is the position of edges.values[k].to: a descent reads all neighbours from one place.
  std::vector<Eigen::Vector3d> neighbour_positions;
  std::vector<std::uint32_t> shell;  ///< connected component of each node
  std::uint32_t shell_count = 0;
  /// Power of two, metres: at most 2^-50 of the sum of all edge lengths.
  double length_quantum = 0.0;

  std::size_t nodeCount() const { return positions.size(); }
  std::size_t memoryBytes() const;
};

/// Nodes that no triangle uses are left without edges and form shells of their own; shells are numbered by
/// their first node. O(n log n).
NodeGraph buildNodeGraph(const SurfaceMesh& grid);

}  // namespace concave_distance
