#pragma once

#include <vector>

#include "local_minima.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// Every triangle pair that meets, up to rounding, until the limit is reached.
void collectMeetingPairs(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost,
                         WorkLimit& limit);

}  // namespace concave_distance::detail
