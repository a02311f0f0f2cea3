#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Reads binary or ASCII STL, three vertices a triangle, in the order of the file. A file is text when the
/// name line of its first solid is followed by a facet or an end; its words may be in capitals, facets may
/// have more than three corners, several solids may follow each other, and after the last one anything but a
/// facet. A binary file may be followed by padding, or by less than a facet.
/// @throws Error naming the file and the line or counts, when it breaks off or announces fewer facets than
///         follow
TriangleSoup readStl(std::string_view content, const std::string& path, std::uint64_t most_triangles);

}  // namespace concave_distance::detail
