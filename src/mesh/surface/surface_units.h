#pragma once

#include <cstdint>
#include <vector>

#include "edge_table.h"

namespace concave_distance::detail {

/// The unit number of sheets, which have free edges and so enclose nothing.
inline constexpr std::uint32_t kSheet = 0xffffffffU;

/// Sets of faces that may enclose space, each examined separately.
struct SurfaceUnits {
  std::vector<std::uint32_t> unit_of_face;  ///< kSheet for what is in none
  std::uint32_t count = 0;
};

/// Patches are faces connected over edges of exactly two faces. A patch with a free edge is a sheet and is
/// removed, which may give other patches free edges. A patch with an even number of faces at each of its
/// edges is closed by itself and becomes a unit, so that solids sharing an edge or a corner are separated,
/// even when they overlap. What is left, such as solids that share faces, makes one unit for each set
/// connected by edges. `faces` are distinct. O(n log n) for each round that removes anything.
SurfaceUnits splitIntoUnits(const std::vector<TriangleNodes>& faces, const EdgeTable& edges);

}  // namespace concave_distance::detail
