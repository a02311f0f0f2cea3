#include "comb_ga_parameters.h"

#include "base/parameter_checks.h"
#include "comb_ga_parameter_table.h"

namespace concave_distance {

void CombGaParameters::validate(const std::string& where) const {
  requireAllowed(combGaParameters(), *this, where);
  if (elite_count > population_size) {
    detail::refuse(where, "elite_count", std::to_string(elite_count), "0 to population_size");
  }
}

}  // namespace concave_distance
