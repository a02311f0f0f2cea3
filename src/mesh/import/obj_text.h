#pragma once

#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Returns the content of an OBJ file: vertices and triangles in their order, 17 digits.
std::string objText(const TriangleSoup& soup);
std::string objText(const SurfaceMesh& mesh);

}  // namespace concave_distance::detail
