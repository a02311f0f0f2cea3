#include "simulation_parameters.h"

namespace concave_distance {

const ParameterTable<SimulationSettings>& simulationParameters() {
  using S = SimulationSettings;
  using Trackings = std::vector<std::pair<std::string, SimulationTracking>>;
  static const ParameterTable<S> table = {
      number<S>(
          "duration", [](auto& s) -> auto& { return s.duration; }, "simulated time")
          .inUnit("s")
          .above(0.0),
      number<S>(
          "largest_step", [](auto& s) -> auto& { return s.largest_step; }, "no step is longer")
          .inUnit("s")
          .above(0.0),
      number<S>(
          "step_fraction", [](auto& s) -> auto& { return s.step_fraction; },
          "share of sqrt(m / k) of the stiffest contact or drive, and of a radian, that a step takes at most")
          .above(0.0)
          .to(1.0),
      number<S>(
          "allowed_penetration", [](auto& s) -> auto& { return s.allowed_penetration; },
          "how far beyond the proven distance any point may move against the other body in one step")
          .inUnit("m")
          .above(0.0),
      number<S>(
          "log_rate", [](auto& s) -> auto& { return s.log_rate; }, "lines per second of simulated time")
          .above(0.0),
      choice<S>(
          "tracking",
          Trackings{{"niches", SimulationTracking::Niches},
                    {"single_minimum", SimulationTracking::SingleMinimum},
                    {"both", SimulationTracking::Both}},
          [](auto& s) -> auto& { return s.tracking; },
          "`niches`: every local minimum is followed; `single_minimum`: only the proven distance, and the "
          "last "
          "cycle's closest pair moved downhill; `both`: to compare them"),
  };
  return table;
}

}  // namespace concave_distance
