#pragma once

#include "concave_distance/mesh/surface/round_shape.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// A closed convex mesh around what a sphere or a capsule is a ball swept along: its centre, or the segment
/// of its axis. No point of the mesh is farther than `thickness` (metres) from that.
struct CoreMesh {
  SurfaceMesh surface;  ///< shape frame
  double thickness;
};

/// @param shape sphere or capsule
/// @param where the body, for messages
CoreMesh coreMesh(const RoundShape& shape, const std::string& where);

}  // namespace concave_distance::detail
