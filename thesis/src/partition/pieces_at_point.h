#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "convex_piece.h"

namespace concave_distance {

/// The pieces that hold a point (body frame) or come within `reach` of their radius of it; the nearest one by
/// its half-spaces when there is none. `pieces` is cleared first and keeps its capacity. O(pieces).
void findPiecesAt(const ConvexPartition& partition, const Eigen::Vector3d& point, double reach,
                  std::vector<std::uint32_t>& pieces);

}  // namespace concave_distance
