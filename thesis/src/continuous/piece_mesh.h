#pragma once

#include <cstdint>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "constraint_tree.h"

namespace concave_distance {

/// The convex piece as a closed, outward surface, for looking at: its own constraints and those of its
/// ancestors, within the bounding box. What its children take out of it is not taken out. By clipping the
/// box, in doubles; for pieces as trees have them, O(constraints^2). Body frame, metres.
/// @throws Error when there is no such piece or the constraints leave no volume
SurfaceMesh pieceMesh(const ConstraintTree& tree, std::uint32_t piece);

}  // namespace concave_distance
