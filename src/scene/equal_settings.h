#pragma once

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Returns whether two pairs of the same bodies would be answered and warned of alike.
bool haveEqualSettings(const PairSettings& l, const PairSettings& r);

}  // namespace concave_distance::detail
