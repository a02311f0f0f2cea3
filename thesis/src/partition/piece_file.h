#pragma once

#include <string>

#include "convex_piece.h"

namespace concave_distance {

/// Writes the pieces as a Wavefront OBJ that any viewer shows: one `o` a piece, polygons with their outward
/// normals, 17 digits. @throws Error when the file cannot be written
void writePieces(const ConvexPartition& partition, const std::string& path);

}  // namespace concave_distance
