#pragma once

#include <string>

#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/scene/simulation_settings.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// The section `simulation` of a scene file, poses files with it.
/// @throws Error: file, line, key, what is wrong and what is allowed
SimulationSettings readSimulation(const YamlValue& value, const std::string& base_folder,
                                  const PackageLocator& package_locator);

}  // namespace concave_distance::detail
