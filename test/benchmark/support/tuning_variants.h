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

/// One parameter changed at a time, most of them down and up. The first changes nothing, a `before` is what
/// was shipped before. `searchVariants` change the cold search, `cycleVariants` a warm one, `shareVariants`
/// the work that it may do beside the cones.
std::vector<TuningVariant> searchVariants();
std::vector<TuningVariant> cycleVariants();
std::vector<TuningVariant> shareVariants();

}  // namespace concave_distance::benchmark
