#include "comb_ga_parameter_table.h"

#include "search/genetic_parameter_table.h"

namespace concave_distance {
namespace {

using G = CombGaParameters;

/// Gives the core's part of the parameters.
struct PartOfCore {
  GeneticParameters& operator()(G& g) const { return g; }
  const GeneticParameters& operator()(const G& g) const { return g; }
};

Parameter<G> ofCore(const std::string& name) {
  return partOf<G>(*findParameter(geneticParameters(), name), PartOfCore());
}

std::vector<std::pair<std::string, Cooling>> coolings() {
  return {{"constant", Cooling::Constant},
          {"linear", Cooling::Linear},
          {"exponential", Cooling::Exponential},
          {"boltzmann", Cooling::Boltzmann}};
}

ParameterTable<G> ofVariation() {
  return {
      ofCore("population_size"),
      ofCore("max_generations"),
      ofCore("crossover_probability"),
      ofCore("exchange_probability"),
      choice<G>(
          "mutation",
          std::vector<std::pair<std::string, MutationMethod>>{{"random_move", MutationMethod::RandomMove},
                                                              {"random_nodes", MutationMethod::RandomNodes}},
          [](auto& g) -> auto& { return g.mutation; },
          "`random_move`: an individual moves one node or both towards random ones; `random_nodes`: each of "
          "its nodes, with the mutation probability, becomes a random one"),
      ofCore("mutation_probability"),
      number<G>(
          "final_mutation_probability_factor",
          [](auto& g) -> auto& { return g.final_mutation_probability_factor; },
          "the mutation probability ends at this multiple"),
      choice<G>(
          "mutation_probability_cooling", coolings(),
          [](auto& g) -> auto& { return g.mutation_probability_cooling; }, "how it gets there"),
      optionalNumber<G>(
          "mutation_radius", "none", [](auto& g) -> auto& { return g.mutation_radius; },
          "mesh distance of a mutation; `none`: anywhere on the shell")
          .inUnit("m")
          .above(0.0),
      choice<G>(
          "mutation_radius_cooling", coolings(), [](auto& g) -> auto& { return g.mutation_radius_cooling; },
          "how the radius falls over the generations; from the larger body's extent where none is given"),
  };
}

ParameterTable<G> ofMethods() {
  using Selections = std::vector<std::pair<std::string, SelectionMethod>>;
  using Matings = std::vector<std::pair<std::string, MatingMethod>>;
  using Nichings = std::vector<std::pair<std::string, NichingScheme>>;
  using Optimizations = std::vector<std::pair<std::string, LocalOptimization>>;
  using Moves = std::vector<std::pair<std::string, DescentMoves>>;
  return {
      choice<G>(
          "selection",
          Selections{{"stochastic_universal_sampling", SelectionMethod::StochasticUniversalSampling},
                     {"roulette", SelectionMethod::Roulette}},
          [](auto& g) -> auto& { return g.selection; }, "of parents"),
      choice<G>(
          "mating",
          Matings{{"mesh", MatingMethod::Mesh},
                  {"mesh_near_fitter", MatingMethod::MeshNearFitter},
                  {"phenotypic", MatingMethod::Phenotypic},
                  {"genotypic", MatingMethod::Genotypic}},
          [](auto& g) -> auto& { return g.mating; }, "where children stand between their parents"),
      choice<G>(
          "niching",
          Nichings{
              {"none", NichingScheme::None},
              {"sharing", NichingScheme::Sharing},
              {"dynamic_sharing", NichingScheme::DynamicSharing},
              {"deterministic_crowding", NichingScheme::DeterministicCrowding},
              {"deterministic_crowding_with_selection", NichingScheme::DeterministicCrowdingWithSelection},
              {"simple_crowding", NichingScheme::SimpleCrowding}},
          [](auto& g) -> auto& { return g.scheme; }, "what keeps several niches in the population"),
      choice<G>(
          "local_optimization",
          Optimizations{{"none", LocalOptimization::None},
                        {"lamarckian", LocalOptimization::Lamarckian},
                        {"baldwinian", LocalOptimization::Baldwinian}},
          [](auto& g) -> auto& { return g.local_optimization; },
          "`lamarckian`: every new trial point moves to the local minimum that it descends to; `baldwinian`: "
          "it counts as fit as that minimum and stays"),
      choice<G>(
          "descent_moves",
          Moves{{"one_node", DescentMoves::OneNode}, {"both_nodes", DescentMoves::BothNodes}},
          [](auto& g) -> auto& { return g.descent_moves; },
          "`one_node`: a descent moves one node at a time; `both_nodes`: where no such move is left, both at "
          "once"),
      flag<G>(
          "descend_first_population", [](auto& g) -> auto& { return g.descend_first_population; },
          "descend the first population before parents are selected from it"),
  };
}

ParameterTable<G> ofNiching() {
  return {
      ofCore("sharing_radius"),
      number<G>(
          "sharing_exponent", [](auto& g) -> auto& { return g.sharing_exponent; }, "of the sharing function")
          .above(0.0),
      number<G>(
          "fitness_epsilon", [](auto& g) -> auto& { return g.fitness_epsilon; },
          "differences of distance below this share of the longer grid edge do not count"),
      count<G>(
          "dynamic_niche_limit", [](auto& g) -> auto& { return g.dynamic_niche_limit; },
          "peaks of dynamic sharing")
          .from(1.0),
      ofCore("mating_radius"),
      flag<G>(
          "mating_restriction", [](auto& g) -> auto& { return g.mating_restriction; },
          "mate within the mating radius"),
      flag<G>(
          "strict_mating_restriction", [](auto& g) -> auto& { return g.strict_mating_restriction; },
          "who finds no partner within the mating radius does not mate; otherwise, after two tries, with "
          "anybody"),
      ofCore("niche_radius"),
      count<G>(
          "crowding_factor", [](auto& g) -> auto& { return g.crowding_factor; }, "of simple crowding")
          .from(1.0),
  };
}

ParameterTable<G> ofTheRun() {
  return {
      number<G>(
          "generation_gap", [](auto& g) -> auto& { return g.generation_gap; },
          "share of the population replaced in a generation")
          .above(0.0)
          .to(1.0),
      ofCore("random_immigrants"),
      count<G>(
          "elite_count", [](auto& g) -> auto& { return g.elite_count; },
          "best individuals that always survive"),
      flag<G>(
          "conserve_niches", [](auto& g) -> auto& { return g.conserve_niches; },
          "with sharing: the best of every niche survives too"),
      count<G>(
          "convergence_generations", [](auto& g) -> auto& { return g.convergence_generations; },
          "stop after so many generations without change; 0: never early"),
      count<G>(
          "evaluation_limit", [](auto& g) -> auto& { return g.evaluation_limit; },
          "no further descent after so many evaluations; 0: no limit"),
  };
}

}  // namespace

const ParameterTable<CombGaParameters>& combGaParameters() {
  static const ParameterTable<G> table = joined<G>({ofVariation(), ofMethods(), ofNiching(), ofTheRun()});
  return table;
}

}  // namespace concave_distance
