#include "concave_distance/search/genetic_parameters.h"

#include <cmath>

#include "concave_distance/base/parameter_checks.h"

namespace concave_distance {

using detail::refuse;
using detail::requireLength;
using detail::requireNotNegative;
using detail::requireShare;
using detail::toText;

void GeneticParameters::validate(const std::string& where) const {
  if (population_size < 2 || population_size % 2 != 0) {
    refuse(where, "population_size", std::to_string(population_size), "an even number, 2 or more");
  }
  requireShare(where, "crossover_probability", crossover_probability);
  requireShare(where, "exchange_probability", exchange_probability);
  requireShare(where, "mutation_probability", mutation_probability.value_or(0.0));
  requireNotNegative(where, "final_mutation_probability_factor", final_mutation_probability_factor);
  requireLength(where, "mutation_radius", mutation_radius);
  if (shrinking_mutation_radius && !mutation_radius) {
    refuse(where, "shrinking_mutation_radius", "true without mutation_radius", "with a mutation_radius only");
  }
  requireLength(where, "sharing_radius", sharing_radius);
  if (!(sharing_exponent > 0.0) || std::isinf(sharing_exponent)) {
    refuse(where, "sharing_exponent", toText(sharing_exponent), "a positive number");
  }
  requireNotNegative(where, "fitness_epsilon", fitness_epsilon);
  if (dynamic_niche_limit == 0) {
    refuse(where, "dynamic_niche_limit", "0", "1 or more");
  }
  requireLength(where, "mating_radius", mating_radius);
  requireLength(where, "niche_radius", niche_radius);
  if (crowding_factor == 0) {
    refuse(where, "crowding_factor", "0", "1 or more");
  }
  if (!(generation_gap > 0.0 && generation_gap <= 1.0)) {
    refuse(where, "generation_gap", toText(generation_gap), "more than 0, up to 1");
  }
  if (elite_count > population_size) {
    refuse(where, "elite_count", std::to_string(elite_count), "0 to population_size");
  }
}

}  // namespace concave_distance
