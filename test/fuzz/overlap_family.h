#pragma once

#include "fuzz/niche_families.h"

namespace concave_distance::test {

/// Two bodies that overlap, often in several parts, at one pose.
NicheScene drawOverlappingPair(RandomEngine& engine);

}  // namespace concave_distance::test
