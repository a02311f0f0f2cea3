#pragma once

#include <cstdint>
#include <vector>

#include "edge_table.h"

namespace concave_distance::detail {

/// Belongs to no unit: a sheet, which has free edges and so encloses nothing.
inline constexpr std::uint32_t kSheet = 0xffffffffU;

/// Sets of faces that may enclose something, each looked at by itself.
struct SurfaceUnits {
  std::vector<std::uint32_t> unit_of_face;  ///< kSheet for what is in none
  std::uint32_t count = 0;
};

/// Patches are faces joined over edges of just two. A patch with an edge of its own alone is a sheet and is
/// taken away, which may leave other edges with one face only. A patch that has an even number of faces at
/// each of its edges is closed by itself and becomes a unit: solids that share an edge or a corner part here,
/// however they overlap. What is left, such as solids that share faces, makes one unit for each set connected
/// by edges. `faces` are distinct. O(n log n) for each round that takes anything away.
SurfaceUnits splitIntoUnits(const std::vector<TriangleNodes>& faces, const EdgeTable& edges);

}  // namespace concave_distance::detail
