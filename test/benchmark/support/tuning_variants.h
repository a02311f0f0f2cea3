#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance::benchmark {

/// The shipped parameters with a change.
struct TuningVariant {
  std::string name;
  std::function<void(TrackerParameters&)> change;
};

/// One parameter changed at a time, most of them down and up, beside a few that change together. The first
/// changes nothing. `searchVariants` change the cold search alone, `cycleVariants` what a warm cycle does.
std::vector<TuningVariant> searchVariants();
std::vector<TuningVariant> cycleVariants();

}  // namespace concave_distance::benchmark
