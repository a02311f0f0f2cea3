#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Reads every mesh of a COLLADA file by assimp, placed by the file's nodes, in metres by its <unit>, with
/// the axes of the file. A node that mirrors turns the winding. A hostile file may crash or hang this
/// process, or use all memory.
/// @throws Error naming the file, as plainDae and FileMesh::takeTriangles
TriangleSoup readDae(std::string_view content, const std::string& path, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
