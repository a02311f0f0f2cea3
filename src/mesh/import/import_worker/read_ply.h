#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Reads a PLY file, text or binary of either byte order: vertices, faces and triangle strips, in any order
/// and with any properties. Other elements are passed over by what the header says about them.
/// @throws Error naming the file and the line or element, when the body has less or more than the header
///         announces, and as readPlyHeader and FileMesh::takeTriangles
TriangleSoup readPly(std::string_view content, const std::string& path, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
