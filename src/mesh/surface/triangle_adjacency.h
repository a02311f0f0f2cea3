#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "compressed_rows.h"
#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh_topology.h"

namespace concave_distance {

/// A triangle next to another and what they share: an edge (from, to), or one vertex (from == to).
struct AdjacentTriangle {
  TriangleIndex triangle;
  NodeIndex from;
  NodeIndex to;
};

/// Rows of neighbours.
/// @param for_each (visit) calls visit(row, neighbour) for each of them, the same at both calls
template <typename ForEach>
CompressedRows<AdjacentTriangle> adjacencyRows(std::size_t count, const ForEach& for_each) {
  CompressedRows<AdjacentTriangle> rows;
  rows.offsets.assign(count + 1, 0);
  for_each([&](std::uint32_t row, const AdjacentTriangle&) { ++rows.offsets[row + 1]; });
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.values.resize(rows.offsets.back());
  std::vector<std::uint32_t> place(rows.offsets.begin(), rows.offsets.end() - 1);
  for_each([&](std::uint32_t row, const AdjacentTriangle& next) { rows.values[place[row]++] = next; });
  return rows;
}

/// Returns for every triangle those across its edges, or the next one in a ring where more than 8 meet
/// at an edge; and where triangles hang together at a vertex alone, a chain over that vertex. Triangles
/// that touch are connected by such steps, all of which contain the point where they touch. O(n log n)
/// time, O(n) memory.
CompressedRows<AdjacentTriangle> triangleAdjacency(const SurfaceMesh& mesh, const MeshTopology& topology);

}  // namespace concave_distance
