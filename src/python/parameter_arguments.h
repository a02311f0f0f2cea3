#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "concave_distance/scene/scene.h"

namespace concave_distance::python {

/// Sets what the keywords name. A value of None is the parameter's word: no limit, or automatic.
/// @throws Error naming `where`, the keyword, the value seen and what is allowed
void setParameters(const pybind11::kwargs& keywords, const std::string& where, TrackerParameters& parameters);
/// The same for the pairs of a scene: bodies have the margins, and each cycle says whether niches are wanted.
void setParameters(const pybind11::kwargs& keywords, const std::string& where, PairSettings& settings);

/// Returns name and value of each keyword of a pair.
pybind11::dict valuesOf(const TrackerParameters& parameters);

/// Returns one dict for each keyword of a pair, or of a scene: name, unit, default, allowed, description,
/// is_expert.
pybind11::list describeParameters(bool of_scene);

}  // namespace concave_distance::python
