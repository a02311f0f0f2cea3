#pragma once

#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/vertex_fans.h"

namespace concave_distance::detail {

/// The two ends that all fans of a node have in common: the borders of its patches go through it from one to
/// the other. Both are the node itself where they do not.
std::array<NodeIndex, 2> commonEnds(NodeIndex node, const std::vector<VertexFan>& fans);

/// Returns by node whether the borders of its patches go straight through it. All such nodes may go together:
/// the border between two that stay is a segment, and those on it lie within `tolerance` metres of it
/// (Douglas and Peucker 1973).
std::vector<bool> findStraightNodes(const SurfaceMesh& mesh, const PatchedMesh& patched, double tolerance);

}  // namespace concave_distance::detail
