#include "concave_distance/scene/warning_monitor.h"

namespace concave_distance {

bool WarningMonitor::update(std::optional<double> distance, double warning_distance, double hysteresis) {
  const WarningState before = state_;
  if (!distance) {
    state_ = WarningState::Unknown;
    return state_ != before;
  }
  if (*distance < warning_distance) {
    was_warning_ = true;
  } else if (*distance > warning_distance + hysteresis) {
    was_warning_ = false;
  }
  state_ = was_warning_ ? WarningState::Warning : WarningState::Clear;
  return state_ != before;
}

void WarningMonitor::reset() {
  *this = WarningMonitor();
}

}  // namespace concave_distance
