#include "concave_distance/scene/simulation_settings.h"

#include "concave_distance/base/parameter_checks.h"

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
  detail::requirePositive(where, "duration", duration, "seconds");
  detail::requirePositive(where, "largest_step", largest_step, "seconds");
  detail::requirePositive(where, "allowed_penetration", allowed_penetration, "metres");
  detail::requirePositive(where, "log_rate", log_rate, "lines a second");
  if (!(step_fraction > 0.0 && step_fraction <= 1.0)) {
    detail::refuse(where, "step_fraction", detail::toText(step_fraction), "greater than 0, at most 1");
  }
}

}  // namespace concave_distance
