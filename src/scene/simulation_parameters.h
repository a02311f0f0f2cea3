#pragma once

#include "base/parameter.h"
#include "concave_distance/scene/simulation_settings.h"

namespace concave_distance {

/// The numbers and choices of a simulation: files, command lines, messages and documents are made
/// from this table.
const ParameterTable<SimulationSettings>& simulationParameters();

}  // namespace concave_distance
