#pragma once

#include "base/parameter.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Every setting of a pair but its effects and the genetic algorithm: files, the node's parameters, command
/// lines, messages and documents are made from it.
const ParameterTable<PairSettings>& pairParameters();

}  // namespace concave_distance
