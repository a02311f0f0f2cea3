#include "genetic_parameter_table.h"

namespace concave_distance {

namespace {

using G = GeneticParameters;

std::vector<std::pair<std::string, Cooling>> coolings() {
  return {{"constant", Cooling::Constant},
          {"linear", Cooling::Linear},
          {"exponential", Cooling::Exponential},
          {"boltzmann", Cooling::Boltzmann}};
}

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
      choice<G>(
          "mutation",
          std::vector<std::pair<std::string, MutationMethod>>{{"random_move", MutationMethod::RandomMove},
                                                              {"random_nodes", MutationMethod::RandomNodes}},
          [](auto& g) -> auto& { return g.mutation; },
          "`random_move`: an individual moves one node or both towards random ones; `random_nodes`: each of "
          "its nodes, with the mutation probability, becomes a random one")
          .forExperiments(),
      optionalNumber<G>(
          "mutation_probability", "auto", [](auto& g) -> auto& { return g.mutation_probability; },
          "of an individual; `auto`: 1 / `population_size`")
          .to(1.0),
      number<G>(
          "final_mutation_probability_factor",
          [](auto& g) -> auto& { return g.final_mutation_probability_factor; },
          "the mutation probability ends at this multiple")
          .forExperiments(),
      choice<G>(
          "mutation_probability_cooling", coolings(),
          [](auto& g) -> auto& { return g.mutation_probability_cooling; }, "how it gets there")
          .forExperiments(),
      optionalNumber<G>(
          "mutation_radius", "none", [](auto& g) -> auto& { return g.mutation_radius; },
          "mesh distance of a mutation; `none`: anywhere on the shell")
          .inUnit("m")
          .above(0.0)
          .forExperiments(),
      choice<G>(
          "mutation_radius_cooling", coolings(), [](auto& g) -> auto& { return g.mutation_radius_cooling; },
          "how the radius falls over the generations; from the larger body's extent where none is given")
          .forExperiments(),
  };
}

ParameterTable<G> ofMethods() {
  using Selections = std::vector<std::pair<std::string, SelectionMethod>>;
  using Matings = std::vector<std::pair<std::string, MatingMethod>>;
  using Nichings = std::vector<std::pair<std::string, NichingMethod>>;
  using Optimizations = std::vector<std::pair<std::string, LocalOptimization>>;
  using Moves = std::vector<std::pair<std::string, DescentMoves>>;
  return {
      choice<G>(
          "selection",
          Selections{{"stochastic_universal_sampling", SelectionMethod::StochasticUniversalSampling},
                     {"roulette", SelectionMethod::Roulette}},
          [](auto& g) -> auto& { return g.selection; }, "of parents")
          .forExperiments(),
      choice<G>(
          "mating",
          Matings{{"mesh", MatingMethod::Mesh},
                  {"mesh_near_fitter", MatingMethod::MeshNearFitter},
                  {"phenotypic", MatingMethod::Phenotypic},
                  {"genotypic", MatingMethod::Genotypic}},
          [](auto& g) -> auto& { return g.mating; }, "where children stand between their parents")
          .forExperiments(),
      choice<G>(
          "niching",
          Nichings{
              {"none", NichingMethod::None},
              {"sharing", NichingMethod::Sharing},
              {"dynamic_sharing", NichingMethod::DynamicSharing},
              {"deterministic_crowding", NichingMethod::DeterministicCrowding},
              {"deterministic_crowding_with_selection", NichingMethod::DeterministicCrowdingWithSelection},
              {"simple_crowding", NichingMethod::SimpleCrowding}},
          [](auto& g) -> auto& { return g.niching; }, "what keeps several niches in the population")
          .withExperimentChoices(
              {"dynamic_sharing", "deterministic_crowding_with_selection", "simple_crowding"}),
      choice<G>(
          "local_optimization",
          Optimizations{{"none", LocalOptimization::None},
                        {"lamarckian", LocalOptimization::Lamarckian},
                        {"baldwinian", LocalOptimization::Baldwinian}},
          [](auto& g) -> auto& { return g.local_optimization; },
          "`lamarckian`: every new trial point moves to the local minimum that it descends to; `baldwinian`: "
          "it counts as fit as that minimum and stays")
          .forExperiments(),
      choice<G>(
          "descent_moves",
          Moves{{"one_node", DescentMoves::OneNode},
                {"both_nodes", DescentMoves::BothNodes},
                {"one_node_along_edges", DescentMoves::OneNodeAlongEdges}},
          [](auto& g) -> auto& { return g.descent_moves; },
          "`one_node`: a descent moves one node at a time; `both_nodes`: where no such move is left, both at "
          "once")
          .withExperimentChoices({"one_node_along_edges"}),
      flag<G>(
          "descend_first_population", [](auto& g) -> auto& { return g.descend_first_population; },
          "descend the first population before parents are selected from it")
          .forExperiments(),
  };
}

ParameterTable<G> ofNiching() {
  return {
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
      count<G>(
          "dynamic_niche_limit", [](auto& g) -> auto& { return g.dynamic_niche_limit; },
          "peaks of dynamic sharing")
          .from(1.0)
          .forExperiments(),
      optionalNumber<G>(
          "mating_radius", "auto", [](auto& g) -> auto& { return g.mating_radius; },
          "mesh distance; `auto`: 1.25 sharing radii")
          .inUnit("m")
          .above(0.0),
      flag<G>(
          "mating_restriction", [](auto& g) -> auto& { return g.mating_restriction; },
          "mate within the mating radius"),
      flag<G>(
          "strict_mating_restriction", [](auto& g) -> auto& { return g.strict_mating_restriction; },
          "who finds no partner within the mating radius does not mate; otherwise, after two tries, with "
          "anybody")
          .forExperiments(),
      optionalNumber<G>(
          "niche_radius", "auto", [](auto& g) -> auto& { return g.niche_radius; },
          "mesh distance; `auto`: the sharing radius")
          .inUnit("m")
          .above(0.0),
      count<G>(
          "crowding_factor", [](auto& g) -> auto& { return g.crowding_factor; }, "of simple crowding")
          .from(1.0)
          .forExperiments(),
  };
}

ParameterTable<G> ofTheRun() {
  return {
      number<G>(
          "generation_gap", [](auto& g) -> auto& { return g.generation_gap; },
          "share of the population replaced in a generation")
          .above(0.0)
          .to(1.0)
          .forExperiments(),
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
          "convergence_generations", [](auto& g) -> auto& { return g.convergence_generations; },
          "stop after so many generations without change; 0: never early")
          .forExperiments(),
      count<G>(
          "evaluation_limit", [](auto& g) -> auto& { return g.evaluation_limit; },
          "no further descent after so many evaluations; 0: no limit"),
  };
}

}  // namespace

const ParameterTable<GeneticParameters>& allGeneticParameters() {
  static const ParameterTable<G> table = joined<G>({ofVariation(), ofMethods(), ofNiching(), ofTheRun()});
  return table;
}

const ParameterTable<GeneticParameters>& geneticParameters() {
  static const ParameterTable<G> table = withoutExperiments(allGeneticParameters());
  return table;
}

}  // namespace concave_distance
