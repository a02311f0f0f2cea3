#pragma once

#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "hull_gap.h"
#include "mesh/surface/mesh_topology.h"
#include "normal_cone_tree.h"

namespace concave_distance {

/// Marks the groups of a body's cones that hold a feature beside a dent. Any other feature supports the hull:
/// no point of the body is farther than 2 HullGap::shallow in front of it, along any of its directions.
/// @return by slot; empty where the gap marks no triangles
std::vector<bool> markDentedGroups(const NormalConeTree& cones, const SurfaceMesh& mesh,
                                   const MeshTopology& topology, const HullGap& gap);

}  // namespace concave_distance
