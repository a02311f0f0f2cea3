#pragma once

#include <string>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance {

/// Writes a surface; the format follows the file name's ending (stl, obj, ply).
/// @throws Error for an unknown ending or a file that cannot be written
void exportMesh(const SurfaceMesh& mesh, const std::string& path);

}  // namespace concave_distance
