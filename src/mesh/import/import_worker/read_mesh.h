#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// importMesh() without a worker process; used by mesh_import_worker. A hostile file may crash or hang it, or
/// use all memory. It opens no file.
/// @param content the whole file; `path` names it in errors
/// @param extension .stl, .obj, .ply or .dae: chooses the reader
/// @throws Error as importMesh
TriangleSoup readMesh(std::string_view content, const std::string& path, const std::string& extension,
                      const Eigen::Vector3d& scale, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
