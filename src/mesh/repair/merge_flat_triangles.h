#pragma once

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Merging moves no point of the surface farther than this fraction of the bounding box's diagonal by
/// default: as far as repair may move a vertex.
inline constexpr double kMergeTolerance = kSinglePrecisionWeld;

struct MergedMesh {
  SurfaceMesh mesh;
  std::size_t flat_patches = 0;  ///< of the input: triangles of one plane that hang together
};

/// Leaves out nodes within flat patches and along their straight borders, and cuts the patches into triangles
/// of what is left: n + 2 h - 2 for n corners and h holes, the fewest there are. Nodes that stay do not move,
/// and a border loses a node in all its patches at once, so closed shells stay closed, and sheets keep their
/// borders. A node stays where leaving it out would join two that are joined already elsewhere. Triangles
/// without area are left alone.
/// @param tolerance metres; no point of either surface is farther from the other one
MergedMesh mergeFlatTriangles(const SurfaceMesh& mesh, double tolerance);

}  // namespace concave_distance
