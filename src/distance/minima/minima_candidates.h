#pragma once

#include <vector>

#include "concave_distance/base/work_limit.h"
#include "dented_pairs.h"
#include "distance/kernels/pair_frame.h"
#include "local_minima_cost.h"

namespace concave_distance::detail {

/// Looks through all normal cones (doc/proofs.md) and appends triangle pairs that hold local
/// minima between 0 and `cutoff`, metres, some more than once, until the limit is reached.
void collectConeCandidates(const PairFrame& frame, ConeChoice choice, double cutoff,
                           std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost,
                           WorkLimit& limit);

}  // namespace concave_distance::detail
