#pragma once

#include <cmath>

#include "cell_levels.h"
#include "mesh/surface/triangle_adjacency.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// A step from a triangle pair to one that has an edge, or a vertex, of one triangle in common with it:
/// @param step (triangle of A, triangle of B, squared level): the least distance over what both pairs share
template <typename Step>
void forEachNeighbour(const MinimaScene& scene, TriangleIndex a, TriangleIndex b,
                      const TrianglePoints& corners_a, const TrianglePoints& corners_b,
                      const CellLevels& levels, const Step& step) {
  const auto over = [](const TriangleNodes& nodes, const TrianglePoints& corners,
                       const AdjacentTriangle& next, const std::array<double, 3>& edges,
                       const TrianglePoints& other) {
    std::size_t k = 0;
    while (k < 2 && nodes[k] != next.from) ++k;
    return next.from != next.to ? edges[k] : pointTriangleDistance(corners[k], other).squared_distance;
  };
  const TriangleNodes& nodes_a = scene.a.surface().triangle(a);
  const TriangleNodes& nodes_b = scene.b.surface().triangle(b);
  for (const AdjacentTriangle& next : scene.adjacency_a.row(a.value)) {
    step(next.triangle, b, over(nodes_a, corners_a, next, levels.edges_of_a, corners_b));
  }
  for (const AdjacentTriangle& next : scene.adjacency_b.row(b.value)) {
    step(a, next.triangle, over(nodes_b, corners_b, next, levels.edges_of_b, corners_a));
  }
}

}  // namespace concave_distance::detail
