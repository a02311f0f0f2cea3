#pragma once

#include <cmath>

#include "base/side.h"
#include "cell_levels.h"
#include "mesh/surface/triangle_adjacency.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// What two neighbouring triangle pairs have in common: an edge of one body's triangle, or a vertex of it
/// (from == to), with a triangle of the other body.
struct SharedElement {
  Side side;  ///< of the edge
  NodeIndex from;
  NodeIndex to;
  TriangleIndex other;
};

/// A step from a triangle pair to one that has an edge, or a vertex, of one triangle in common with it:
/// @param step (triangle of A, triangle of B, squared level, shared element): the level is the least distance
/// over what both pairs share
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
    step(next.triangle, b, over(nodes_a, corners_a, next, levels.edges_of_a, corners_b),
         SharedElement{Side::A, next.from, next.to, b});
  }
  for (const AdjacentTriangle& next : scene.adjacency_b.row(b.value)) {
    step(a, next.triangle, over(nodes_b, corners_b, next, levels.edges_of_b, corners_a),
         SharedElement{Side::B, next.from, next.to, a});
  }
}

/// The closest points over a shared element, in the scene's frame.
inline TrianglePairDistance closestOver(const MinimaScene& scene, const SharedElement& element) {
  if (element.side == Side::A) {
    const Eigen::Vector3d from = scene.vertexOfA(element.from);
    const Eigen::Vector3d to = scene.vertexOfA(element.to);
    return triangleDistance({from, to, to}, scene.cornersOfB(element.other));
  }
  const Eigen::Vector3d from = scene.vertexOfB(element.from);
  const Eigen::Vector3d to = scene.vertexOfB(element.to);
  return triangleDistance(scene.cornersOfA(element.other), {from, to, to});
}

}  // namespace concave_distance::detail
