#pragma once

#include "concave_distance/scene/tracked_pair.h"

namespace concave_distance::test {

/// What a cycle is asked for a pair: nothing, the distance, the niches too, the effects too.
inline constexpr PairDemand kIdle{};
inline constexpr PairDemand kDistance{true, true, false, false};
inline constexpr PairDemand kNiches{true, true, true, false};
inline constexpr PairDemand kContacts{true, true, true, true};

/// Coordinates of order 1, a few operations: the distance of two boxes is right to this.
inline constexpr double kRounding = 1e-12;

}  // namespace concave_distance::test
