#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Holds what a path along the surface can reach: triangles that hang together by edges or corners. Solids
/// that share an edge are shells of their own (MeshTopology) but one piece.
struct ConnectedPieces {
  std::vector<std::uint32_t> piece_of_triangle;
  std::uint32_t count = 0;
};

/// Numbered in the order of their first triangles. O(n).
ConnectedPieces connectedPieces(const SurfaceMesh& mesh);

}  // namespace concave_distance
