#pragma once

#include "base/side.h"
#include "distance/kernels/pair_frame.h"
#include "facet_pair_levels.h"
#include "mesh/surface/triangle_adjacency.h"

namespace concave_distance::detail {

/// Names what two neighbouring facet pairs have in common: an edge of one body's facet, or a vertex of it
/// (from == to), with a facet of the other body.
struct SharedElement {
  Side side;  ///< of the edge
  NodeIndex from;
  NodeIndex to;
  TriangleIndex other;
};

/// The closest points over a shared element, in the frame's frame.
inline TrianglePairDistance closestOver(const PairFrame& frame, const SharedElement& element) {
  const Eigen::Vector3d from = frame.ownVertex(element.side, element.from);
  const Eigen::Vector3d to = frame.ownVertex(element.side, element.to);
  if (element.side == Side::A) {
    return facetDistance({{from, to, to, from}}, frame.facetOfB(element.other)).closest;
  }
  const Eigen::Vector3d from_in_a = frame.rotation * from + frame.offset;
  const Eigen::Vector3d to_in_a = frame.rotation * to + frame.offset;
  return facetDistance(frame.facetOfA(element.other), {{from_in_a, to_in_a, to_in_a, from_in_a}}).closest;
}

/// The squared level over what a facet of body `side` and the next one have in common, with `other` on the
/// other body.
/// @param edges squared levels of the facet's edges
inline double squaredLevelOver(const PairFrame& frame, Side side, const std::array<NodeIndex, 4>& nodes,
                               const FacetPoints& points, const AdjacentTriangle& next,
                               const std::array<double, 4>& edges, TriangleIndex other,
                               const FacetPoints& other_points) {
  if (PairFrame::isJoint(side == Side::A ? frame.a : frame.b, next)) {
    return closestOver(frame, {side, next.from, next.to, other}).squared_distance;
  }
  std::size_t k = 0;
  while (k < 3 && nodes[k] != next.from) ++k;
  if (next.from != next.to) return edges[k];
  const Eigen::Vector3d& point = points.corners[k];
  return facetDistance({{point, point, point, point}}, other_points).closest.squared_distance;
}

/// A step from a facet pair to one that has an edge, a vertex or a joint of one facet in common with it:
/// @param step (facet of A, facet of B, squared level, shared element): the level is the least distance over
/// what both facet pairs share
template <typename Step>
void forEachNeighbour(const PairFrame& frame, TriangleIndex a, TriangleIndex b, const FacetPoints& points_a,
                      const FacetPoints& points_b, const FacetPairLevels& levels, const Step& step) {
  const std::array<NodeIndex, 4>& nodes_a = frame.facets_a->nodes[a.value];
  const std::array<NodeIndex, 4>& nodes_b = frame.facets_b->nodes[b.value];
  for (const AdjacentTriangle& next : frame.adjacency_a->row(a.value)) {
    step(next.triangle, b,
         squaredLevelOver(frame, Side::A, nodes_a, points_a, next, levels.edges_of_a, b, points_b),
         SharedElement{Side::A, next.from, next.to, b});
  }
  for (const AdjacentTriangle& next : frame.adjacency_b->row(b.value)) {
    step(a, next.triangle,
         squaredLevelOver(frame, Side::B, nodes_b, points_b, next, levels.edges_of_b, a, points_a),
         SharedElement{Side::B, next.from, next.to, a});
  }
}

}  // namespace concave_distance::detail
