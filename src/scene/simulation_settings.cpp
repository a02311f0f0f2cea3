#include "concave_distance/scene/simulation_settings.h"

#include "base/parameter_checks.h"
#include "simulation_parameters.h"

namespace concave_distance {

std::string_view toString(BodyMotion motion) {
  switch (motion) {
    case BodyMotion::Fixed:
      return "fixed";
    case BodyMotion::Driven:
      return "driven";
    case BodyMotion::Free:
      return "free";
  }
  return "unknown";
}

std::string_view toString(SimulationTracking tracking) {
  switch (tracking) {
    case SimulationTracking::Niches:
      return "niches";
    case SimulationTracking::SingleMinimum:
      return "single_minimum";
    case SimulationTracking::Both:
      return "both";
  }
  return "unknown";
}

void SimulationSettings::validate(const std::string& where) const {
  if (!gravity.allFinite()) detail::refuse(where, "gravity", "not finite", "three finite numbers, m/s^2");
  requireAllowed(simulationParameters(), *this, where);
}

}  // namespace concave_distance
