#pragma once

#include "base/parameter.h"
#include "comb_ga_parameters.h"

namespace concave_distance {

/// The parameters of comb-GA that experiments read: the core's and what is compared with it.
const ParameterTable<CombGaParameters>& combGaParameters();

}  // namespace concave_distance
