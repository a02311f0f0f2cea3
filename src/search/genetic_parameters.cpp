#include "concave_distance/search/genetic_parameters.h"

#include "base/parameter_checks.h"
#include "genetic_parameter_table.h"

namespace concave_distance {

void GeneticParameters::validate(const std::string& where) const {
  requireAllowed(geneticParameters(), *this, where);
  if (shrinking_mutation_radius && !mutation_radius) {
    detail::refuse(where, "shrinking_mutation_radius", "true without mutation_radius",
                   "with a mutation_radius only");
  }
  if (elite_count > population_size) {
    detail::refuse(where, "elite_count", std::to_string(elite_count), "0 to population_size");
  }
}

}  // namespace concave_distance
