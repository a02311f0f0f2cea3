#pragma once

#include "scene_spec.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// One entry of `clouds`: a body that stands for what a sensor will see. @throws Error for what is wrong with
/// it
BodySpec readCloudSpec(const YamlValue& value);

}  // namespace concave_distance::detail
