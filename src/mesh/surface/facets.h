#pragma once

#include <array>
#include <vector>

#include "mesh_topology.h"
#include "triangle_adjacency.h"

namespace concave_distance {

/// A surface as flat convex pieces: triangles, and pairs of triangles in one plane that are a quadrangle
/// together. A facet is named by its first triangle, the larger one.
struct Facets {
  std::vector<TriangleIndex> facet_of_triangle;
  std::vector<TriangleIndex> second;  ///< by facet; kNoTriangle: there is none
  /// Each facet's nodes run the way its triangle does: the first three are the first triangle's, and the edge
  /// between both joins the first and the third. A triangle's fourth is its first again.
  std::vector<std::array<NodeIndex, 4>> nodes;

  bool isQuad(TriangleIndex facet) const { return second[facet.value] != kNoTriangle; }
};

/// Joins triangles of one shell, wound alike, that have an edge in common with no third one. No point of a
/// quadrangle is farther than 2^-47.4 of the mesh's diameter from the plane of its first triangle.
/// @param hidden by triangle, left alone; empty: none is
Facets joinFlatTriangles(const SurfaceMesh& mesh, const MeshTopology& topology,
                         const std::vector<bool>& hidden);

/// Turns rows by triangle into rows by facet; other rows are empty.
CompressedRows<AdjacentTriangle> facetAdjacency(const Facets& facets,
                                                const CompressedRows<AdjacentTriangle>& adjacency);

}  // namespace concave_distance
