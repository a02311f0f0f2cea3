#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "working_frame.h"

namespace concave_distance::detail {

struct CandidatePair {
  TriangleIndex a;
  TriangleIndex b;
};

/// Pairs of triangles in leaves whose boxes meet, by descending both trees at once: all that could touch or
/// cross, and more. Allocates nothing once the vectors have grown. False when the limit was reached first.
bool collectCandidates(const WorkingFrame& frame, std::vector<std::pair<std::uint32_t, std::uint32_t>>& stack,
                       std::vector<CandidatePair>& candidates, WorkLimit& limit);

}  // namespace concave_distance::detail
