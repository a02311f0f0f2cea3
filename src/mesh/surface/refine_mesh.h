#pragma once

#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// A conforming subdivision of a surface: the same set of points, every original vertex a node.
struct RefinedMesh {
  SurfaceMesh mesh;
  std::vector<TriangleIndex> original_triangle;  ///< per refined triangle, the one it lies in
};

/// Longest-edge bisection (Rivara 1984) until no edge exceeds `max_edge_length`, metres. New nodes are edge
/// midpoints, shared across edges also where shells have borders or non-manifold edges. No vertex moves.
/// @throws Error when max_edge_length is not positive, or when more than `node_limit` nodes would result
RefinedMesh refineToEdgeLength(const SurfaceMesh& mesh, double max_edge_length,
                               std::size_t node_limit = 20'000'000);

}  // namespace concave_distance
