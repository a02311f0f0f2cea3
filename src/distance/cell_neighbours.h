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

/// The closest points over a shared element, in the scene's frame.
inline TrianglePairDistance closestOver(const MinimaScene& scene, const SharedElement& element) {
  const Eigen::Vector3d from = scene.ownVertex(element.side, element.from);
  const Eigen::Vector3d to = scene.ownVertex(element.side, element.to);
  if (element.side == Side::A) return triangleDistance({from, to, to}, scene.cornersOfB(element.other));
  const Eigen::Vector3d from_in_a = scene.frames.rotation * from + scene.frames.offset;
  const Eigen::Vector3d to_in_a = scene.frames.rotation * to + scene.frames.offset;
  return triangleDistance(scene.cornersOfA(element.other), {from_in_a, to_in_a, to_in_a});
}

/// The squared level over what a triangle of body `side` and the next one have in common, with `other` on the
/// other body.
/// @param edges squared levels of the triangle's edges
inline double squaredLevelOver(const MinimaScene& scene, Side side, const TriangleNodes& nodes,
                               const TrianglePoints& corners, const AdjacentTriangle& next,
                               const std::array<double, 3>& edges, TriangleIndex other,
                               const TrianglePoints& other_corners) {
  if (MinimaScene::isJoint(side == Side::A ? scene.a : scene.b, next)) {
    return closestOver(scene, {side, next.from, next.to, other}).squared_distance;
  }
  std::size_t k = 0;
  while (k < 2 && nodes[k] != next.from) ++k;
  return next.from != next.to ? edges[k] : pointTriangleDistance(corners[k], other_corners).squared_distance;
}

/// A step from a triangle pair to one that has an edge, a vertex or a joint of one triangle in common with
/// it:
/// @param step (triangle of A, triangle of B, squared level, shared element): the level is the least distance
/// over what both pairs share
template <typename Step>
void forEachNeighbour(const MinimaScene& scene, TriangleIndex a, TriangleIndex b,
                      const TrianglePoints& corners_a, const TrianglePoints& corners_b,
                      const CellLevels& levels, const Step& step) {
  const TriangleNodes& nodes_a = scene.a.surface().triangle(a);
  const TriangleNodes& nodes_b = scene.b.surface().triangle(b);
  for (const AdjacentTriangle& next : scene.adjacency_a.row(a.value)) {
    step(next.triangle, b,
         squaredLevelOver(scene, Side::A, nodes_a, corners_a, next, levels.edges_of_a, b, corners_b),
         SharedElement{Side::A, next.from, next.to, b});
  }
  for (const AdjacentTriangle& next : scene.adjacency_b.row(b.value)) {
    step(a, next.triangle,
         squaredLevelOver(scene, Side::B, nodes_b, corners_b, next, levels.edges_of_b, a, corners_a),
         SharedElement{Side::B, next.from, next.to, a});
  }
}

}  // namespace concave_distance::detail
