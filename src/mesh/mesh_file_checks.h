#pragma once

#include <string>

namespace concave_distance::detail {

/// The file name's ending with its dot, in lower case.
std::string lowerCaseExtension(const std::string& path);

/// Finds what assimp would pass over in silence: a file that is missing, no file at all or empty, and an STL
/// or PLY file that breaks off (assimp takes the facets it finds for all, and makes up missing faces). An OBJ
/// file has no mark of its end, and a broken DAE is malformed XML, which assimp reports.
/// @throws Error naming the file
void checkMeshFile(const std::string& path);

}  // namespace concave_distance::detail
