#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Even nodes for the search on a surface: every original vertex keeps its place and number, edges between
/// faces that are not flat against each other are divided evenly, flat faces are triangulated anew.
struct SearchGrid {
  SurfaceMesh mesh;
  /// Per node, an original triangle that it lies on: up to the rounding of the coordinates.
  std::vector<TriangleIndex> original_triangle_of_node;
};

/// Triangulates each flat patch of a surface by a constrained Delaunay triangulation (Lawson 1977) of its
/// vertices, the nodes on its edges and a triangular lattice, and splits what is still too long, until no
/// edge exceeds max_edge_length (1 + 1e-9), metres. The lattice spends 1.3 / max_edge_length^2 nodes on a
/// unit of area; bisection (refineToEdgeLength) takes 1.2 to 3 times the nodes on bodies with large faces,
/// and more slivers.
///
/// A patch is flat when its vertices lie within 4e-7 of the body's diameter of one plane: what single
/// precision leaves of a plane in a file. So far may a grid triangle deviate from the surface; its nodes lie
/// on it up to the rounding of a coordinate. Edges between patches, of one or of more than two triangles stay
/// edges, and the grid conforms. A surface without an edge too long is its own grid. The same input gives the
/// same grid.
/// @throws Error when max_edge_length is not positive, a triangle has a corner twice (see repairMesh), or
/// more
///         than `node_limit` nodes would result
SearchGrid makeSearchGrid(const SurfaceMesh& surface, double max_edge_length,
                          std::size_t node_limit = 20'000'000);

}  // namespace concave_distance
