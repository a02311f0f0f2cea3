#include "alerts.h"

#include "base/constants.h"

namespace concave_distance {
namespace {

static_assert(Alert::CLEAR == static_cast<int>(WarningState::Clear));
static_assert(Alert::WARNING == static_cast<int>(WarningState::Warning));
static_assert(Alert::UNKNOWN == static_cast<int>(WarningState::Unknown));

PairDistance toDistance(const PublishedPair& pair) {
  if (pair.tracked->solved()) return toDistance(pair.heading, pair.tracked->solution);
  PairDistance distance = emptyDistance(pair.heading, pair.status);
  if (pair.tracked->box_bound) {
    distance.has_lower_bound = 1;
    distance.lower_bound = *pair.tracked->box_bound;
  }
  return distance;
}

}  // namespace

Alert toAlert(const PublishedPair& pair) {
  Alert alert;
  alert.nearest = toDistance(pair);
  alert.header = alert.nearest.header;
  alert.state = static_cast<std::uint8_t>(pair.tracked->warning.state());
  alert.warning_distance = pair.tracked->settings.warning_distance.value_or(kNotComputed);
  alert.hysteresis = pair.tracked->settings.warning_hysteresis;
  return alert;
}

Alert clearedAlert(const PairHeading& heading, const OtherPairs& others) {
  PairStatus status;
  const bool is_beyond = others.beyond > 0;
  status.code = is_beyond ? PairStatus::BEYOND_CUTOFF : PairStatus::DISABLED;
  status.message = is_beyond ? "no pair with a warning distance is near" : "no pair has a warning distance";
  Alert alert;
  alert.nearest = emptyDistance(heading, status);
  if (is_beyond) {
    alert.nearest.has_lower_bound = 1;
    alert.nearest.lower_bound = others.lower_bound;
  }
  alert.header = alert.nearest.header;
  alert.state = Alert::CLEAR;
  alert.warning_distance = alert.hysteresis = kNotComputed;
  return alert;
}

}  // namespace concave_distance
