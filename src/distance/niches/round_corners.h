#pragma once

#include "niche_corners.h"

namespace concave_distance {

/// Does what findCorners() does for an exact round solid and a mesh: where the solid's side or flat end is
/// level with the mesh, the corners of its inscribed mesh are moved to the solid's own ends and rim. The
/// closest points of a level disc are one more: the witness is exact in its distance, and less so sideways.
/// @param witness on the solid, with the triangles of the meshes that are nearest
/// @return 0 for two round solids and for spheres
std::size_t findRoundCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                             const WitnessPair& witness, double tolerance, double least_length,
                             std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                             CornerPairs& corners);

}  // namespace concave_distance
