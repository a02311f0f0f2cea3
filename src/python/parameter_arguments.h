#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance::python {

/// Says what a keyword may set besides the declared parameters of a tracker.
enum class Keywords {
  OfPair,  ///< margins and niches_wanted
  OfScene  ///< nothing: bodies have the margins, and each cycle says whether niches are wanted
};

/// Sets what the keywords name. A value of None is the parameter's word: no limit, or automatic.
/// @throws Error naming `where`, the keyword, the value seen and what is allowed
void setParameters(const pybind11::kwargs& keywords, Keywords allowed, const std::string& where,
                   TrackerParameters& parameters);

/// Returns name and value of each keyword of a pair.
pybind11::dict valuesOf(const TrackerParameters& parameters);

/// Returns one dict for each keyword of a pair: name, unit, default, allowed, description, is_expert.
pybind11::list describeParameters();

}  // namespace concave_distance::python
