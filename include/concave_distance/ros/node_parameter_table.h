#pragma once

#include "concave_distance/base/parameter.h"
#include "concave_distance/ros/node_parameters.h"

namespace concave_distance {

/// The node's own parameters, declared once; those of pairs are pairParameters().
const ParameterTable<NodeParameters>& nodeParameterTable();
/// Those below `limits`.
const ParameterTable<NodeLimits>& limitParameters();

}  // namespace concave_distance
