#pragma once

#include <string>

#include "search/grid/search_nodes.h"

namespace concave_distance {

/// The nodes of experiments, as makeSearchNodes() with the thesis's even grid (makeSearchGrid()).
SearchNodes makeGridNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                          const std::string& where);

}  // namespace concave_distance
