#include "pair_parameters.h"

#include "tracking/tracker_parameter_table.h"

namespace concave_distance {

const ParameterTable<PairSettings>& pairParameters() {
  using S = PairSettings;
  static const ParameterTable<S> table = [] {
    ParameterTable<S> all;
    for (const Parameter<TrackerParameters>& parameter : trackerParameters()) {
      all.push_back(partOf<S>(
          parameter, [](auto& s) -> auto& { return s.tracker; }));
    }
    const ParameterTable<S> warnings = {
        optionalNumber<S>(
            "warning_distance", "none", [](auto& s) -> auto& { return s.warning_distance; },
            "an alert is raised below; not beyond the cutoff")
            .inUnit("m"),
        number<S>(
            "warning_hysteresis", [](auto& s) -> auto& { return s.warning_hysteresis; },
            "the alert is taken back above the warning distance plus this")
            .inUnit("m"),
    };
    all.insert(all.end(), warnings.begin(), warnings.end());
    return all;
  }();
  return table;
}

}  // namespace concave_distance
