#pragma once

#include <string>

#include "thesis/src/partition/convex_piece.h"

namespace concave_distance::test {

/// Reads what writePieces wrote, or pieces made by hand: `o`, `v`, `vn`, `f` lines, corners of a piece after
/// its `o`. Without normals they are computed, and then each piece must be convex to 1e-7 of its radius.
/// @throws Error naming the file and the line or piece
ConvexPartition readPieces(const std::string& path);

}  // namespace concave_distance::test
