#pragma once

#include <vector>

#include "edge_table.h"
#include "face_table.h"
#include "surface_units.h"

namespace concave_distance::detail {

/// Which side of a face: 2 f for its front, 2 f + 1 for its back.
using FaceSide = std::uint32_t;

/// Seen along an edge from its lower to its higher node, faces are arranged around it like the pages of a
/// book: each face has a side that faces counter-clockwise and one that faces clockwise.
inline FaceSide sideAhead(HalfEdge half_edge) {
  return 2 * (half_edge / 3) + (half_edge % 3 == 2 ? 1U : 0U);
}
inline FaceSide sideBehind(HalfEdge half_edge) {
  return sideAhead(half_edge) ^ 1U;
}

/// Sorts the faces of one edge counter-clockwise around it, from its first one, by exact predicates. Faces
/// that overlap in one plane are ordered by their patches, consistently at every edge. O(k log k).
void sortAroundEdge(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                    const std::vector<std::uint32_t>& patch_of_face, std::vector<HalfEdge>& fan);

/// The cell of space on each side of each face. Sides that face each other around an edge of their unit share
/// a cell, as do both sides of a face at a free edge. Faces that meet without a common edge do not separate
/// cells. A cell is named by one of its sides. O(n log n).
std::vector<FaceSide> findCells(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                                const EdgeTable& edges, const SurfaceUnits& units);

}  // namespace concave_distance::detail
