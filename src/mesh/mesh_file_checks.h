#pragma once

#include <string>

namespace concave_distance::detail {

/// The file name's ending with its dot, in lower case.
std::string lowerCaseExtension(const std::string& path);

/// Finds what assimp passes over in silence or stumbles on: a file that is missing, no file at all or empty;
/// an STL or PLY file that breaks off (assimp takes the facets it finds for all, and makes up missing faces);
/// a DAE whose lists are not what they say. An OBJ file has no mark of its end.
/// @throws Error naming the file
void checkMeshFile(const std::string& path);

}  // namespace concave_distance::detail
