#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/pair_table.h"
#include "search/pair_objective.h"

namespace concave_distance::benchmark {

/// Buffers of floodForDeeper; cleared, never freed.
struct FloodWorkspace {
  PairTable seen{12};
  std::vector<TrialPoint> heap;
};

/// Floods the product of both graphs from a discrete local minimum, in order of distance, and stops at the
/// first node pair that is closer than the start by more than `noise` (metres): the start is then no niche of
/// its own, for a way below `level` (metres) leads on. Empty when the level or `state_limit` is reached
/// first.
std::optional<TrialPoint> floodForDeeper(const PairObjective& objective, const TrialPoint& start,
                                         double level, double noise, std::uint32_t state_limit,
                                         FloodWorkspace& workspace, SearchCost& cost);

}  // namespace concave_distance::benchmark
