#pragma once

#include <cstdint>
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

/// Returns for every triangle those across its edges, or the next one in a ring where more than 8 meet
/// at an edge; and where triangles hang together at a vertex alone, a chain over that vertex. Triangles
/// that touch are connected by such steps, all of which contain the point where they touch. O(n log n)
/// time, O(n) memory.
CompressedRows<AdjacentTriangle> triangleAdjacency(const SurfaceMesh& mesh, const MeshTopology& topology);

}  // namespace concave_distance
