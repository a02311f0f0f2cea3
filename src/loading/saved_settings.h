#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "yaml_text.h"

namespace concave_distance::detail {

/// Adds the settings of a pair, as scene files name them, that are not those of each of `bases`; all of them
/// without any.
void addSettings(const PairSettings& settings, const std::vector<const PairSettings*>& bases,
                 YamlItems& items);

/// A material as a map of all its values.
std::string savedMaterial(const Material& material);
bool haveEqualValues(const Material& l, const Material& r);

}  // namespace concave_distance::detail
