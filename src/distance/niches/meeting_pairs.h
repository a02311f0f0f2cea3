#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "distance/kernels/pair_frame.h"
#include "local_minima.h"

namespace concave_distance::detail {

/// Nodes of A's and of B's TriangleTree.
using TreeNodePair = std::pair<std::uint32_t, std::uint32_t>;

/// Every triangle pair that meets, up to rounding, until the limit is reached. @param open a buffer
void collectMeetingPairs(const PairFrame& frame, std::vector<TreeNodePair>& open,
                         std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost, WorkLimit& limit);

}  // namespace concave_distance::detail
