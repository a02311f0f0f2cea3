#include "concave_distance/search/genetic_parameters.h"

#include "base/parameter_checks.h"
#include "genetic_parameter_table.h"

namespace concave_distance {

void GeneticParameters::validate(const std::string& where) const {
  requireAllowed(geneticParameters(), *this, where);
}

}  // namespace concave_distance
