#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace concave_distance::detail {

/// The remedy for a file that is broken.
inline constexpr const char* kExportAgain = "export the mesh again";

/// Finds errors that assimp ignores or crashes on: an STL or PLY file that breaks off (assimp accepts the
/// facets it finds and invents missing faces); a PLY header that announces more than the file can hold; a DAE
/// with invalid lists. The end of an OBJ file cannot be checked. Time is linear in the file's size for any
/// content; memory is constant except for a PLY's header.
/// @throws Error naming the file, also for an ending other than .stl, .obj, .ply and .dae
void checkMeshContent(std::string_view content, const std::string& path, const std::string& extension,
                      std::uint64_t most_triangles);

}  // namespace concave_distance::detail
