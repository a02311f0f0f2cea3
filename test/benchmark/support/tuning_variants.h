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

/// One parameter changed at a time, most of them down and up. The first changes nothing, the second is what
/// was shipped before. `searchVariants` change the cold search alone, `coldVariants` what else a cold
/// cycle does, `cycleVariants` what a warm one does.
std::vector<TuningVariant> searchVariants();
std::vector<TuningVariant> coldVariants();
std::vector<TuningVariant> cycleVariants();

}  // namespace concave_distance::benchmark
