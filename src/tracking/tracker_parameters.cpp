#include "concave_distance/tracking/tracker_parameters.h"

#include "tracker_parameter_table.h"

namespace concave_distance {

// Chosen on every second of the benchmark pairs and checked on the others (doc/results/tuning.md).
TrackerParameters::TrackerParameters() {
  cold.population_size = 60;
  cold.max_generations = 40;
  cold.crossover_probability = 1.0;
  cold.exchange_probability = 1.0;
  cold.random_immigrants = 20;
  warm.population_size = 16;
  warm.max_generations = 1;
  warm.random_immigrants = 0;  // TrackerParameters::random_starts enter at the start of a warm cycle
}

void TrackerParameters::validate(const std::string& where) const {
  cold.validate(where + ".cold");
  warm.validate(where + ".warm");
  requireAllowed(trackerParameters(), *this, where);
  requireAllowed(marginParameters(), *this, where);
}

WorkLimit remainingWork(const TrackerParameters& parameters, double seconds_spent) {
  const auto spent =
      std::chrono::duration_cast<WorkLimit::Clock::duration>(std::chrono::duration<double>(seconds_spent));
  return {WorkLimit::Clock::now() - spent, parameters.time_budget, parameters.facet_pair_limit,
          parameters.stop};
}

}  // namespace concave_distance
