#pragma once

#include "base/parameter.h"
#include "node_parameters.h"

namespace concave_distance {

/// The node's own parameters, declared once; those of pairs are pairParameters().
const ParameterTable<NodeParameters>& nodeParameterTable();
/// Those below `limits`.
const ParameterTable<NodeLimits>& limitParameters();

}  // namespace concave_distance
