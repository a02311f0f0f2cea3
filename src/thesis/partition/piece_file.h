#pragma once

#include <string>

#include "convex_piece.h"

namespace concave_distance {

/// Writes the pieces as a Wavefront OBJ that any viewer shows: one `o` a piece, polygons with their outward
/// normals, 17 digits. @throws Error when the file cannot be written
void writePieces(const ConvexPartition& partition, const std::string& path);

/// Reads what writePieces wrote, or pieces made by hand: `o`, `v`, `vn`, `f` lines, corners of a piece after
/// its `o`. Without normals they are computed, and then each piece must be convex to 1e-7 of its radius.
/// @throws Error naming the file and the line or piece
ConvexPartition readPieces(const std::string& path);

}  // namespace concave_distance
