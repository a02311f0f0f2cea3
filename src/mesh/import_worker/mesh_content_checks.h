#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace concave_distance::detail {

/// Finds what assimp passes over in silence or stumbles on: an STL or PLY file that breaks off (assimp takes
/// the facets it finds for all, and makes up missing faces); a PLY header that announces more than the file
/// can hold; a DAE whose lists are not what they say. An OBJ file has no mark of its end. Time is linear in
/// the file's size whatever it says, memory constant but for a PLY's header.
/// @throws Error naming the file, also for an ending other than .stl, .obj, .ply and .dae
void checkMeshContent(std::string_view content, const std::string& path, const std::string& extension,
                      std::uint64_t most_triangles);

}  // namespace concave_distance::detail
