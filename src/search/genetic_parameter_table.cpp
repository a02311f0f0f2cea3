#include "genetic_parameter_table.h"

namespace concave_distance {

namespace {

using G = GeneticParameters;

ParameterTable<G> ofVariation() {
  return {
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
  };
}

ParameterTable<G> ofNiching() {
  return {
      choice<G>(
          "niching",
          std::vector<std::pair<std::string, NichingMethod>>{
              {"sharing", NichingMethod::Sharing},
              {"deterministic_crowding", NichingMethod::DeterministicCrowding}},
          [](auto& g) -> auto& { return g.niching; }, "what keeps several niches in the population"),
      optionalNumber<G>(
          "sharing_radius", "auto", [](auto& g) -> auto& { return g.sharing_radius; },
          "mesh distance over both bodies")
          .inUnit("m")
          .above(0.0),
      number<G>(
          "sharing_exponent", [](auto& g) -> auto& { return g.sharing_exponent; }, "of the sharing function")
          .above(0.0),
      number<G>(
          "fitness_epsilon", [](auto& g) -> auto& { return g.fitness_epsilon; },
          "differences of distance below this share of the longer grid edge do not count"),
      optionalNumber<G>(
          "mating_radius", "auto", [](auto& g) -> auto& { return g.mating_radius; },
          "mesh distance; `auto`: 1.25 sharing radii")
          .inUnit("m")
          .above(0.0),
      flag<G>(
          "mating_restriction", [](auto& g) -> auto& { return g.mating_restriction; },
          "mate within the mating radius"),
      optionalNumber<G>(
          "niche_radius", "auto", [](auto& g) -> auto& { return g.niche_radius; },
          "mesh distance; `auto`: the sharing radius")
          .inUnit("m")
          .above(0.0),
  };
}

ParameterTable<G> ofTheRun() {
  return {
      count<G>(
          "random_immigrants", [](auto& g) -> auto& { return g.random_immigrants; },
          "random trial points tried in each generation"),
      count<G>(
          "elite_count", [](auto& g) -> auto& { return g.elite_count; },
          "best individuals that always survive"),
      flag<G>(
          "conserve_niches", [](auto& g) -> auto& { return g.conserve_niches; },
          "with sharing: the best of every niche survives too"),
      count<G>(
          "evaluation_limit", [](auto& g) -> auto& { return g.evaluation_limit; },
          "no further descent after so many evaluations; 0: no limit"),
  };
}

}  // namespace

const ParameterTable<GeneticParameters>& geneticParameters() {
  static const ParameterTable<G> table = joined<G>({ofVariation(), ofNiching(), ofTheRun()});
  return table;
}

}  // namespace concave_distance
