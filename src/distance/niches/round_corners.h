#pragma once

#include "niche_corners.h"

namespace concave_distance {

/// Does what findCorners() does where one body is an exact round solid, or both are. Over a mesh: where the
/// solid's side or flat end is level with it, the corners of its inscribed mesh are moved to the solid's own
/// ends and rim. The closest points of a level disc are one more: the witness is exact in its distance, and
/// less so sideways. Of two solids: the ends of sides that are parallel, of a side's chord under a flat end,
/// points around what two flat ends share.
/// @param witness with the triangles of the meshes that are nearest; of two solids with points alone
/// @return 0 for spheres
std::size_t findRoundCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                             const WitnessPair& witness, double tolerance, double least_length,
                             std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                             CornerPairs& corners);

}  // namespace concave_distance
