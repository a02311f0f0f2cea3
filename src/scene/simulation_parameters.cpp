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
          "share of sqrt(m / k) of contacts and drives that swing, and of a radian, that a step takes at "
          "most; what is at rest in them holds no step back")
          .above(0.0)
          .to(1.0),
      automatic<S>(
          "allowed_penetration", [](auto& s) -> auto& { return s.allowed_penetration; },
          "how far beyond the proven distance any point may move against the other body in one step, at "
          "most: nothing thicker is passed through unseen; "
          "`auto`, and while the bodies are apart where it is less: a share of the depth that the contact "
          "reaches by its stiffness, mass and speed")
          .inUnit("m"),
      number<S>(
          "work_tolerance", [](auto& s) -> auto& { return s.work_tolerance; },
          "error that one step may make, as a share of the work that the contact or drive does in it; five "
          "times as much of friction's")
          .above(0.0)
          .to(1.0),
      number<S>(
          "energy_tolerance", [](auto& s) -> auto& { return s.energy_tolerance; },
          "error of the energy balance, as a share of the energy that went through, above which `simulate` "
          "reports a failure")
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
