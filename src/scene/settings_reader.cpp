#include "settings_reader.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();

bool positiveFinite(double v) {
  return v > 0.0 && std::isfinite(v);
}
bool notNegativeFinite(double v) {
  return v >= 0.0 && std::isfinite(v);
}
bool share(double v) {
  return v >= 0.0 && v <= 1.0;
}

constexpr const char* kLength = "greater than 0, metres";
constexpr const char* kShare = "from 0 to 1";

std::uint32_t count32(const YamlValue& value, std::uint64_t least, std::uint64_t most = kMost32,
                      const std::string& remark = "") {
  return static_cast<std::uint32_t>(value.count(least, most, remark));
}

// A number of the predicate's kind, or the word that stands for "empty".
template <typename Predicate>
std::optional<double> optionalNumber(const YamlValue& value, const char* word, const std::string& allowed,
                                     const Predicate& accepts) {
  if (value.isText(word)) return std::nullopt;
  return value.number(allowed + ", or " + word, accepts);
}

constexpr std::pair<const char*, AccuracyLevel> kAccuracyLevels[] = {{"nodes", AccuracyLevel::Nodes},
                                                                     {"refined", AccuracyLevel::Refined},
                                                                     {"certified", AccuracyLevel::Certified},
                                                                     {"complete", AccuracyLevel::Complete}};
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

// The three radii of niching, which the settings may give for cold and warm cycles at once.
void readRadii(YamlMap& map, GeneticParameters& p) {
  if (auto v = map.take("sharing_radius"))
    p.sharing_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
  if (auto v = map.take("mating_radius"))
    p.mating_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
  if (auto v = map.take("niche_radius")) p.niche_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
}

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
  readRadii(map, p);
  map.finish();
}

void readTrackerParameters(YamlMap& map, TrackerParameters& p) {
  if (auto v = map.take("accuracy")) p.accuracy = v->choice(kAccuracyLevels);
  if (auto v = map.take("absolute_tolerance")) {
    p.absolute_tolerance = v->number("0 or more, metres", notNegativeFinite);
  }
  if (auto v = map.take("relative_tolerance")) p.relative_tolerance = v->number(kShare, share);
  if (auto v = map.take("time_budget")) {
    p.time_budget = v->number("greater than 0, seconds; .inf for none", [](double s) { return s > 0.0; });
  }
  if (auto v = map.take("cutoff")) {
    p.cutoff = v->number("greater than 0, metres; .inf for none", [](double c) { return c > 0.0; });
  }
  if (auto v = map.take("least_prominence")) p.least_prominence = v->number("0 or more", notNegativeFinite);
  if (auto v = map.take("prominence_limit")) {
    p.prominence_limit = v->number("0 or more; .inf for all", [](double x) { return x >= 0.0; });
  }
  if (auto v = map.take("largest_niche_count")) p.largest_niche_count = count32(*v, 1);
  if (auto v = map.take("keep_through_material")) p.keep_through_material = v->boolean();
  if (auto v = map.take("inherited_per_niche")) {
    p.inherited_per_niche = v->number("1 or more", [](double n) { return n >= 1.0 && std::isfinite(n); });
  }
  if (auto v = map.take("inherited_limit")) p.inherited_limit = count32(*v, 0);
  if (auto v = map.take("immigrants")) p.immigrants = count32(*v, 0);
  if (auto v = map.take("search_motion")) p.search_motion = v->number("0 or more", notNegativeFinite);
  if (auto v = map.take("search_interval")) p.search_interval = count32(*v, 1);
  if (auto v = map.take("swept_cones")) p.swept_cones = count32(*v, 0);
  if (auto v = map.take("reviewed_niches")) p.reviewed_niches = count32(*v, 0);
  if (auto v = map.take("projected_niches")) p.projected_niches = count32(*v, 0);
  if (auto v = map.take("projected_immigrants")) p.projected_immigrants = count32(*v, 0);
  if (auto v = map.take("extrapolate")) p.extrapolate = v->boolean();
  if (auto v = map.take("seed")) p.seed = v->count(0, std::numeric_limits<std::uint64_t>::max());
  // Before cold and warm, whose own radii win.
  YamlMap copy = map;
  readRadii(map, p.cold);
  readRadii(copy, p.warm);
  if (auto v = map.take("cold")) readGeneticParameters(*v, p.cold);
  if (auto v = map.take("warm")) readGeneticParameters(*v, p.warm);
}

}  // namespace

void readPairSettings(YamlMap& map, PairSettings& settings) {
  readTrackerParameters(map, settings.tracker);
  if (auto v = map.take("warning_distance")) {
    settings.warning_distance = optionalNumber(*v, "never", "0 or more, metres", notNegativeFinite);
  }
  if (auto v = map.take("warning_hysteresis")) {
    settings.warning_hysteresis = v->number("0 or more, metres", notNegativeFinite);
  }
}

void validatePairSettings(const PairSettings& settings, const std::string& where) {
  settings.tracker.validate(where);
  if (settings.warning_distance && *settings.warning_distance > settings.tracker.cutoff) {
    throw Error(where,
                "warning_distance " + std::to_string(*settings.warning_distance) +
                    " m is beyond the cutoff of " + std::to_string(settings.tracker.cutoff) + " m",
                "nothing is computed there: raise cutoff or lower warning_distance");
  }
}

std::optional<double> readEdgeLength(const YamlValue& value) {
  return optionalNumber(value, "auto", kLength, positiveFinite);
}

double readLength(const YamlValue& value) {
  return value.number(kLength, positiveFinite);
}

}  // namespace concave_distance::detail
