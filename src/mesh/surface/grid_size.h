#pragma once

#include <optional>
#include <string>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// The grid the search needs, chosen for recall and not for accuracy (the exact levels use the original
/// triangles): a stated fraction of the body's diameter, not below what keeps the node count within a few
/// thousand.
double automaticEdgeLength(const SurfaceMesh& surface);

/// Rough number of grid nodes for this edge length, from the area and the lengths of the edges. O(n).
double estimatedNodeCount(const SurfaceMesh& surface, double max_edge_length);

/// @throws Error (naming `where`) when the edge length is not positive and finite, or a triangle has a corner
///         twice
void checkEdgeLength(const SurfaceMesh& surface, const std::optional<double>& max_edge_length,
                     const std::string& where);

}  // namespace concave_distance
