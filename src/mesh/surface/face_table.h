#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// All triangles with the same three corners, in either winding.
struct Face {
  TriangleNodes nodes;        ///< ascending; the face's front is where they run counter-clockwise
  std::uint32_t first = 0;    ///< of its triangles in FaceTable::triangles
  std::uint32_t along = 0;    ///< triangles wound as `nodes`, which face to the front
  std::uint32_t against = 0;  ///< triangles wound the other way

  std::uint32_t copies() const { return along + against; }
  int net() const { return static_cast<int>(along) - static_cast<int>(against); }
};

struct FaceTable {
  std::vector<Face> faces;
  std::vector<std::uint32_t> triangles;  ///< grouped by face, ascending within a group
};

/// Returns whether the corners are an even permutation of their ascending order. No corner may come twice.
bool runsAlong(const TriangleNodes& nodes);

/// Triangles that name a vertex twice belong to no face. O(n log n).
FaceTable buildFaceTable(const std::vector<TriangleNodes>& triangles);

/// The corners of the faces, in the faces' order.
std::vector<TriangleNodes> cornersOf(const FaceTable& table);

}  // namespace concave_distance::detail
