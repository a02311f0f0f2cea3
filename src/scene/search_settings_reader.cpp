#include "search_settings_reader.h"

#include <limits>

#include "setting_values.h"

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, SelectionMethod> kSelectionMethods[] = {
    {"stochastic_universal_sampling", SelectionMethod::StochasticUniversalSampling},
    {"roulette", SelectionMethod::Roulette}};
constexpr std::pair<const char*, MatingMethod> kMatingMethods[] = {{"mesh", MatingMethod::Mesh},
                                                                   {"phenotypic", MatingMethod::Phenotypic},
                                                                   {"genotypic", MatingMethod::Genotypic}};
constexpr std::pair<const char*, NichingMethod> kNichingMethods[] = {
    {"none", NichingMethod::None},
    {"sharing", NichingMethod::Sharing},
    {"dynamic_sharing", NichingMethod::DynamicSharing},
    {"deterministic_crowding", NichingMethod::DeterministicCrowding},
    {"deterministic_crowding_with_selection", NichingMethod::DeterministicCrowdingWithSelection},
    {"simple_crowding", NichingMethod::SimpleCrowding}};
constexpr std::pair<const char*, LocalOptimization> kLocalOptimizations[] = {
    {"none", LocalOptimization::None},
    {"lamarckian", LocalOptimization::Lamarckian},
    {"baldwinian", LocalOptimization::Baldwinian}};
constexpr std::pair<const char*, DescentMoves> kDescentMoves[] = {{"one_node", DescentMoves::OneNode},
                                                                  {"both_nodes", DescentMoves::BothNodes}};

void readOperators(YamlMap& map, GeneticParameters& p) {
  if (auto v = map.take("crossover_probability")) p.crossover_probability = v->number(kShare, share);
  if (auto v = map.take("exchange_probability")) p.exchange_probability = v->number(kShare, share);
  if (auto v = map.take("mutation_probability")) {
    p.mutation_probability = optionalNumber(*v, "auto", kShare, share);
  }
  if (auto v = map.take("final_mutation_probability_factor")) {
    p.final_mutation_probability_factor = v->number("0 or more", notNegativeFinite);
  }
  if (auto v = map.take("mutation_radius")) {
    p.mutation_radius = optionalNumber(*v, "anywhere", kLength, positiveFinite);
  }
  if (auto v = map.take("shrinking_mutation_radius")) p.shrinking_mutation_radius = v->boolean();
  if (auto v = map.take("selection")) p.selection = v->choice(kSelectionMethods);
  if (auto v = map.take("mating")) p.mating = v->choice(kMatingMethods);
  if (auto v = map.take("niching")) p.niching = v->choice(kNichingMethods);
  if (auto v = map.take("local_optimization")) p.local_optimization = v->choice(kLocalOptimizations);
  if (auto v = map.take("descent_moves")) p.descent_moves = v->choice(kDescentMoves);
  if (auto v = map.take("sharing_exponent")) {
    p.sharing_exponent = v->number("greater than 0", positiveFinite);
  }
  if (auto v = map.take("fitness_epsilon")) p.fitness_epsilon = v->number("0 or more", notNegativeFinite);
  if (auto v = map.take("dynamic_niche_limit")) p.dynamic_niche_limit = count32(*v, 1);
  if (auto v = map.take("mating_restriction")) p.mating_restriction = v->boolean();
  if (auto v = map.take("crowding_factor")) p.crowding_factor = count32(*v, 1);
  if (auto v = map.take("generation_gap")) {
    p.generation_gap = v->number("greater than 0, at most 1", [](double g) { return g > 0.0 && g <= 1.0; });
  }
}

}  // namespace

void readNicheRadii(YamlMap& map, GeneticParameters& p) {
  if (auto v = map.take("sharing_radius"))
    p.sharing_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
  if (auto v = map.take("mating_radius"))
    p.mating_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
  if (auto v = map.take("niche_radius")) p.niche_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
}

void readGeneticParameters(const YamlValue& value, GeneticParameters& p) {
  YamlMap map(value, "a map of parameters of the genetic algorithm");
  if (auto v = map.take("population_size")) {
    p.population_size = count32(*v, 2, kMost32, "even");
    if (p.population_size % 2 != 0) v->refuse("an even number from 2");
  }
  if (auto v = map.take("max_generations")) p.max_generations = count32(*v, 0);
  if (auto v = map.take("elite_count")) p.elite_count = count32(*v, 0);
  if (auto v = map.take("immigrants")) p.immigrants = count32(*v, 0);
  if (auto v = map.take("conserve_niches")) p.conserve_niches = v->boolean();
  if (auto v = map.take("convergence_generations")) p.convergence_generations = count32(*v, 0);
  if (auto v = map.take("evaluation_limit")) {
    p.evaluation_limit = v->count(0, std::numeric_limits<std::uint64_t>::max());
  }
  readOperators(map, p);
  readNicheRadii(map, p);
  map.finish();
}

DescentMoves readDescentMoves(const YamlValue& value) {
  return value.choice(kDescentMoves);
}

}  // namespace concave_distance::detail
