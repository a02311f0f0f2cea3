#include "concave_distance/search/genetic_parameters.h"

#include "base/parameter_checks.h"
#include "genetic_parameter_table.h"

namespace concave_distance {

void GeneticParameters::validate(const std::string& where) const {
  requireAllowed(geneticParameters(), *this, where);
  if (elite_count > population_size) {
    detail::refuse(where, "elite_count", std::to_string(elite_count), "0 to population_size");
  }
}

}  // namespace concave_distance
