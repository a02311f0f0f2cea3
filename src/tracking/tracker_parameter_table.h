#pragma once

#include "base/parameter.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Every parameter of a tracker but margins and those of the genetic algorithm (geneticParameters): files,
/// the node's parameters, command lines, messages and documents are made from it.
const ParameterTable<TrackerParameters>& trackerParameters();

/// The margins of A and B, which scenes say of each body instead of a pair.
const ParameterTable<TrackerParameters>& marginParameters();

}  // namespace concave_distance
