#pragma once

#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Writes a surface; the format follows the file name's ending: .stl (binary; the format has single precision
/// and no shared vertices), .obj or .ply (text, 17 digits, vertices and triangles in their order).
/// @throws Error naming the file for an unknown ending or when it cannot be written
void exportMesh(const SurfaceMesh& mesh, const std::string& path);

}  // namespace concave_distance
