#pragma once

#include <vector>

#include "normal_cone_tree.h"

namespace concave_distance::detail {

/// Lists every vertex, edge and face that has a local normal cone on the sides wanted, once for each side.
/// Hidden triangles count as if they were not there; those that another shell meets have both sides: minima
/// in its material, through their own, are deeper places that others may belong to.
std::vector<NormalConeTree::Item> collectConeItems(const SurfaceMesh& mesh, const MeshTopology& topology,
                                                   NormalSides sides, const ShellContacts& joints);

}  // namespace concave_distance::detail
