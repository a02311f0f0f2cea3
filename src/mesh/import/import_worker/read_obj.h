#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Reads the vertices and faces of an OBJ file; names, groups, materials, normals, texture coordinates, lines
/// and points are passed over. A vertex of four numbers is homogeneous.
/// @throws Error naming the file and the line, also for curves and surfaces of free form, whose shape would
///         be lost, and as FileMesh::takeTriangles
TriangleSoup readObj(std::string_view content, const std::string& path, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
