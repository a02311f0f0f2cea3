#include "genetic_parameter_table.h"

namespace concave_distance {

const ParameterTable<GeneticParameters>& geneticParameters() {
  using G = GeneticParameters;
  static const ParameterTable<G> table = {
      count<G>(
          "population_size", [](auto& g) -> auto& { return g.population_size; }, "individuals")
          .from(2.0)
          .even(),
      count<G>(
          "max_generations", [](auto& g) -> auto& { return g.max_generations; }, "generations"),
      number<G>(
          "crossover_probability", [](auto& g) -> auto& { return g.crossover_probability; }, "of a couple")
          .to(1.0),
      number<G>(
          "exchange_probability", [](auto& g) -> auto& { return g.exchange_probability; },
          "share of the couples whose children each take one node from any local minimum met so far")
          .to(1.0),
      optionalNumber<G>(
          "mutation_probability", "auto", [](auto& g) -> auto& { return g.mutation_probability; },
          "of an individual; `auto`: 1 / `population_size`")
          .to(1.0),
      optionalNumber<G>(
          "sharing_radius", "auto", [](auto& g) -> auto& { return g.sharing_radius; },
          "mesh distance over both bodies")
          .inUnit("m")
          .above(0.0),
      optionalNumber<G>(
          "mating_radius", "auto", [](auto& g) -> auto& { return g.mating_radius; },
          "mesh distance; `auto`: 1.25 sharing radii")
          .inUnit("m")
          .above(0.0),
      optionalNumber<G>(
          "niche_radius", "auto", [](auto& g) -> auto& { return g.niche_radius; },
          "mesh distance; `auto`: the sharing radius")
          .inUnit("m")
          .above(0.0),
      count<G>(
          "random_immigrants", [](auto& g) -> auto& { return g.random_immigrants; },
          "random trial points tried in each generation"),
  };
  return table;
}

}  // namespace concave_distance
