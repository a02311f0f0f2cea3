#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "compressed_rows.h"
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

/// One past the highest node that a triangle names.
inline std::size_t nodeCountOf(const std::vector<TriangleNodes>& triangles) {
  std::uint32_t count = 0;
  for (const TriangleNodes& nodes : triangles) {
    for (const NodeIndex node : nodes) count = std::max(count, node.value + 1);
  }
  return count;
}

/// Edges are numbered in the order of their lower, then higher node. O(n log k) for at most k edges at a
/// node.
inline EdgeTable buildEdgeTable(const std::vector<TriangleNodes>& triangles) {
  struct Keyed {
    std::uint32_t high;
    HalfEdge half_edge;
  };
  CompressedRows<Keyed> rows = compressedRows<Keyed>(nodeCountOf(triangles), [&](const auto& visit) {
    for (HalfEdge h = 0; h < 3 * triangles.size(); ++h) {
      const std::uint32_t start = startOf(triangles, h).value;
      const std::uint32_t end = endOf(triangles, h).value;
      visit(std::min(start, end), Keyed{std::max(start, end), h});
    }
  });
  EdgeTable table;
  table.edge_of_half_edge.resize(rows.values.size());
  table.half_edges.reserve(rows.values.size());
  for (std::size_t low = 0; low + 1 < rows.offsets.size(); ++low) {
    const auto begin = rows.values.begin() + rows.offsets[low];
    const auto end = rows.values.begin() + rows.offsets[low + 1];
    std::sort(begin, end, [](const Keyed& l, const Keyed& r) {
      return l.high != r.high ? l.high < r.high : l.half_edge < r.half_edge;
    });
    for (auto keyed = begin; keyed != end; ++keyed) {
      if (keyed == begin || keyed->high != (keyed - 1)->high)
        table.first.push_back(static_cast<std::uint32_t>(table.half_edges.size()));
      table.edge_of_half_edge[keyed->half_edge] = static_cast<std::uint32_t>(table.first.size() - 1);
      table.half_edges.push_back(keyed->half_edge);
    }
  }
  table.first.push_back(static_cast<std::uint32_t>(table.half_edges.size()));
  return table;
}

}  // namespace concave_distance::detail
