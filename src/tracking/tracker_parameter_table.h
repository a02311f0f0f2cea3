#pragma once

#include "base/parameter.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Every parameter of a tracker but those of the genetic algorithm (geneticParameters): files, the node's
/// parameters, command lines, messages and documents are made from it.
const ParameterTable<TrackerParameters>& trackerParameters();

}  // namespace concave_distance
