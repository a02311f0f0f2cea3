#include "concave_distance/tracking/tracker_parameters.h"

#include <cmath>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

/// Smaller than the first buffers of a pair.
constexpr std::size_t kLeastMemory = std::size_t{1} << 20U;

}  // namespace

// Chosen by tuning_benchmark on every second of its pairs and checked on the others (doc/tuning.md).
TrackerParameters::TrackerParameters() {
  cold.niching = NichingMethod::DeterministicCrowding;
  cold.mating_restriction = false;
  cold.population_size = 300;
  cold.immigrants = 20;
  warm.population_size = 16;
  warm.max_generations = 1;
  warm.immigrants = 0;  // TrackerParameters::immigrants enter at the start of a warm cycle
}

void TrackerParameters::validate(const std::string& where) const {
  cold.validate(where + ".cold");
  warm.validate(where + ".warm");
  const auto refuse = [&](const char* key, double value, const char* allowed) {
    throw Error(where + "." + key, "the value is " + std::to_string(value),
                std::string("allowed: ") + allowed);
  };
  if (!(absolute_tolerance >= 0.0) || !std::isfinite(absolute_tolerance)) {
    refuse("absolute_tolerance", absolute_tolerance, "0 or more, metres");
  }
  if (!(relative_tolerance >= 0.0 && relative_tolerance <= 1.0)) {
    refuse("relative_tolerance", relative_tolerance, "from 0 to 1, of the distance");
  }
  if (!(time_budget > 0.0)) {
    refuse("time_budget", time_budget, "greater than 0, seconds, or leave it out");
  }
  if (memory_limit < kLeastMemory) {
    refuse("memory_limit", static_cast<double>(memory_limit), "1048576 (1 MiB) or more, bytes");
  }
  if (!(inherited_per_niche >= 1.0) || !std::isfinite(inherited_per_niche)) {
    refuse("inherited_per_niche", inherited_per_niche, "1 or more");
  }
  if (!(least_prominence >= 0.0) || !std::isfinite(least_prominence)) {
    refuse("least_prominence", least_prominence, "0 or more");
  }
  if (!(prominence_limit >= 0.0)) {
    refuse("prominence_limit", prominence_limit, "0 or more; infinity measures all below the cutoff");
  }
  if (!(search_motion >= 0.0) || !std::isfinite(search_motion)) {
    refuse("search_motion", search_motion, "0 or more, in grid edges");
  }
  if (search_interval == 0) {
    refuse("search_interval", 0, "1 or more cycles");
  }
  if (!(cutoff > 0.0)) {
    refuse("cutoff", cutoff, "a positive length in metres, or leave it out");
  }
  if (largest_niche_count == 0) {
    refuse("largest_niche_count", 0, "1 or more");
  }
}

WorkLimit remainingWork(const TrackerParameters& parameters, double seconds_spent) {
  const auto spent =
      std::chrono::duration_cast<WorkLimit::Clock::duration>(std::chrono::duration<double>(seconds_spent));
  return {WorkLimit::Clock::now() - spent, parameters.time_budget, parameters.memory_limit, parameters.stop};
}

}  // namespace concave_distance
