#pragma once

#include <vector>

#include "normal_cone_tree.h"

namespace concave_distance::detail {

/// Every vertex, edge and face that has a local normal cone on the sides wanted, once for each side. Hidden
/// triangles (empty: there are none) count as if they were not there.
std::vector<NormalConeTree::Item> collectConeItems(const SurfaceMesh& mesh, const MeshTopology& topology,
                                                   NormalSides sides, const std::vector<bool>& hidden);

}  // namespace concave_distance::detail
