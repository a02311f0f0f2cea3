#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Edge k of triangle t, from corner k to corner (k + 1) % 3, stands at position 3 t + k.
using HalfEdge = std::uint32_t;

/// The undirected edges of a mesh, each with every half-edge that runs along it, in either direction.
/// Any number of triangles may share an edge.
struct EdgeTable {
  std::vector<std::uint32_t> edge_of_half_edge;
  std::vector<std::uint32_t> first;  ///< edge count + 1 offsets into half_edges
  std::vector<HalfEdge> half_edges;  ///< grouped by edge, ascending within a group
  std::size_t edgeCount() const { return first.size() - 1; }
};

inline NodeIndex startOf(const std::vector<TriangleNodes>& triangles, HalfEdge half_edge) {
  return triangles[half_edge / 3][half_edge % 3];
}

inline NodeIndex endOf(const std::vector<TriangleNodes>& triangles, HalfEdge half_edge) {
  return triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
}

/// O(n log n). Edges are numbered in the order of their lower, then higher node.
inline EdgeTable buildEdgeTable(const std::vector<TriangleNodes>& triangles) {
  struct Keyed {
    std::uint64_t nodes;
    HalfEdge half_edge;
  };
  std::vector<Keyed> keyed(3 * triangles.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    const auto half_edge = static_cast<HalfEdge>(i);
    const std::uint32_t a = startOf(triangles, half_edge).value;
    const std::uint32_t b = endOf(triangles, half_edge).value;
    keyed[i] = {(std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b), half_edge};
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& l, const Keyed& r) {
    return l.nodes != r.nodes ? l.nodes < r.nodes : l.half_edge < r.half_edge;
  });
  EdgeTable table;
  table.edge_of_half_edge.resize(keyed.size());
  table.half_edges.reserve(keyed.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].nodes != keyed[i - 1].nodes) {
      table.first.push_back(static_cast<std::uint32_t>(i));
    }
    table.edge_of_half_edge[keyed[i].half_edge] = static_cast<std::uint32_t>(table.first.size() - 1);
    table.half_edges.push_back(keyed[i].half_edge);
  }
  table.first.push_back(static_cast<std::uint32_t>(keyed.size()));
  return table;
}

}  // namespace concave_distance::detail
