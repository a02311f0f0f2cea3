#include "experiment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "annealing_reader.h"
#include "concave_distance/base/error.h"
#include "experiment_values.h"
#include "loading/settings_reader.h"
#include "search_readers.h"

namespace concave_distance::evaluation {
namespace {

using detail::count32;
using detail::kShare;
using detail::notNegativeFinite;
using detail::share;
using detail::YamlMap;
using detail::YamlValue;

std::string readText(const std::string& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(file, "cannot be opened", "name an experiment file, e.g. thesis/experiments/table_5_9.yaml");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

CombGaParameters geneticBase(RowBase base, NichingScheme scheme) {
  if (base == RowBase::Thesis) return thesisGeneticParameters(scheme);
  CombGaParameters genetic(base == RowBase::Shipped ? TrackerParameters().cold : GeneticParameters());
  genetic.scheme = scheme;
  return genetic;
}

/// Every method of a family whose name it is tried by.
std::optional<SearchMethod> combinatorialNamed(const std::string& name, RowBase base) {
  if (name == "multi-start") return MultiStartParameters{};
  if (name == "islands") return IslandParameters{2, 5, 10, geneticBase(base, NichingScheme::Sharing)};
  for (const bool local : {true, false}) {
    AnnealingParameters annealing =
        base == RowBase::Thesis ? thesisAnnealingParameters() : AnnealingParameters();
    annealing.local_optimization = local;
    if (concave_distance::nameOf(SearchMethod(annealing)) == name) return annealing;
  }
  for (const auto local :
       {LocalOptimization::None, LocalOptimization::Lamarckian, LocalOptimization::Baldwinian}) {
    for (const auto scheme :
         {NichingScheme::None, NichingScheme::Sharing, NichingScheme::DynamicSharing,
          NichingScheme::DeterministicCrowding, NichingScheme::DeterministicCrowdingWithSelection,
          NichingScheme::SimpleCrowding}) {
      CombGaParameters genetic = geneticBase(base, scheme);
      genetic.local_optimization = local;
      if (concave_distance::nameOf(SearchMethod(genetic)) == name) return genetic;
    }
  }
  return std::nullopt;
}

Method methodNamed(const YamlValue& value, RowBase base) {
  const std::string name = value.text();
  if (base == RowBase::Shipped) {
    const SearchMethod shipped = CombGaParameters(TrackerParameters().cold);
    if (name != concave_distance::nameOf(shipped)) {
      value.refuse(concave_distance::nameOf(shipped) + ", what is shipped; `base: ours` for another");
    }
    return shipped;
  }
  if (base == RowBase::ShippedCycles) {
    const CombGaParameters shipped(TrackerParameters().cold);
    if (name == "islands") return SearchMethod(IslandParameters{2, 5, 10, shipped});
    if (name != concave_distance::nameOf(SearchMethod(shipped))) {
      value.refuse(concave_distance::nameOf(SearchMethod(shipped)) + ", the shipped search; islands");
    }
    return SearchMethod(shipped);
  }
  const bool from_thesis = base == RowBase::Thesis;
  if (name == nameOf(Method(TrackerMethod()))) return TrackerMethod();
  if (name == nameOf(Method(EnumerationMethod()))) return EnumerationMethod();
  for (const bool local : {true, false}) {
    ContinuousGeneticParameters genetic =
        from_thesis ? thesisContinuousGenetic() : improvedContinuousGenetic();
    ContinuousAnnealingParameters annealing =
        from_thesis ? thesisContinuousAnnealing() : improvedContinuousAnnealing();
    genetic.local_step.enabled = annealing.local_step.enabled = local;
    if (nameOf(Method(genetic)) == name) return genetic;
    if (nameOf(Method(annealing)) == name) return annealing;
  }
  const std::optional<SearchMethod> combinatorial = combinatorialNamed(name, base);
  if (combinatorial) return *combinatorial;
  value.refuse(
      "comb-GA-wl, -nl or -bw, with -sh, -ds, -dc, -dcs or -sc or without; comb-SA-wl or -nl; multi-start; "
      "islands; "
      "cont-GA-wl or -nl; cont-SA-wl or -nl; tracker; enumeration");
}

constexpr std::pair<const char*, ContinuousMating> kContinuousMatings[] = {
    {"linear_scaling", ContinuousMating::LinearScaling},
    {"fitness_weighted", ContinuousMating::FitnessWeighted},
    {"fitness_weighted_twice", ContinuousMating::FitnessWeightedTwice}};
constexpr std::pair<const char*, RandomMove> kRandomMoves[] = {
    {"cartesian", RandomMove::Cartesian}, {"random_direction", RandomMove::RandomDirection}};

void readContinuousGenetic(const YamlValue& value, ContinuousGeneticParameters& p) {
  YamlMap map(value, "a map of parameters of cont-GA");
  if (auto v = map.take("population_size")) p.population_size = count32(*v, 2);
  if (auto v = map.take("max_generations")) p.max_generations = count32(*v, 0);
  if (auto v = map.take("crossover_probability")) p.crossover_probability = v->number(kShare, share);
  if (auto v = map.take("mutation_probability")) p.mutation_probability = v->number(kShare, share);
  if (auto v = map.take("penalty_weight"))
    p.penalty_weight = v->number("0 or more, finite", notNegativeFinite);
  if (auto v = map.take("mating")) p.mating = v->choice(kContinuousMatings);
  if (auto v = map.take("mutation")) p.mutation = v->choice(kRandomMoves);
  if (auto v = map.take("variable_displacement")) p.variable_displacement = v->boolean();
  map.finish();
}

void readContinuousAnnealing(const YamlValue& value, ContinuousAnnealingParameters& p) {
  YamlMap map(value, "a map of parameters of cont-SA");
  if (auto v = map.take("initial_temperature")) {
    p.initial_temperature = count32(*v, 1);
  }
  if (auto v = map.take("boltzmann_constant"))
    p.boltzmann_constant = v->number("0 or more, finite", notNegativeFinite);
  if (auto v = map.take("penalty_weight"))
    p.penalty_weight = v->number("0 or more, finite", notNegativeFinite);
  map.finish();
}

/// The settings of a pair, as in a scene file (doc/scene_file.md).
void readTracker(const YamlValue& value, TrackerMethod& method) {
  YamlMap map(value, "settings of a pair");
  if (auto v = map.take("forgets")) method.forgets = v->boolean();
  PairSettings settings;
  settings.tracker = method.parameters;
  detail::readPairSettings(map, settings);
  map.finish();
  method.parameters = settings.tracker;
}

/// Reads the parameters of whatever method it is.
struct ParameterReader {
  const YamlValue& value;
  void operator()(CombGaParameters& p) const { readCombGa(value, p); }
  void operator()(AnnealingParameters& p) const { detail::readAnnealingParameters(value, p); }
  void operator()(MultiStartParameters& p) const { readMultiStart(value, p); }
  void operator()(IslandParameters& p) const { readIslands(value, p); }
  void operator()(SearchMethod& method) const { std::visit(*this, method); }
  void operator()(ContinuousGeneticParameters& p) const { readContinuousGenetic(value, p); }
  void operator()(ContinuousAnnealingParameters& p) const { readContinuousAnnealing(value, p); }
  void operator()(TrackerMethod& method) const { readTracker(value, method); }
  void operator()(EnumerationMethod&) const { value.fail("enumeration has no parameters", "leave them out"); }
};

struct Validator {
  const std::string where;
  void operator()(const MultiStartParameters&) const {}
  void operator()(const EnumerationMethod&) const {}
  void operator()(const TrackerMethod& method) const { method.parameters.validate(where); }
  void operator()(const SearchMethod& method) const { std::visit(*this, method); }
  template <typename Parameters>
  void operator()(const Parameters& parameters) const {
    parameters.validate(where);
  }
};

bool isContinuous(const Method& method) {
  return std::holds_alternative<ContinuousGeneticParameters>(method) ||
         std::holds_alternative<ContinuousAnnealingParameters>(method);
}

constexpr std::pair<const char*, RowBase> kBases[] = {{"thesis", RowBase::Thesis},
                                                      {"ours", RowBase::Ours},
                                                      {"shipped", RowBase::Shipped},
                                                      {"shipped_cycles", RowBase::ShippedCycles}};

/// The warm search of a tracker with a row's parameters, its method's kind.
MotionOptions shippedMotion(const ExperimentRow& row, const YamlValue& value,
                            const std::optional<YamlValue>& parameters) {
  Method warm = row.method;
  auto& search = std::get<SearchMethod>(warm);
  if (auto* islands = std::get_if<IslandParameters>(&search)) {
    islands->genetic = CombGaParameters(TrackerParameters().warm);
  } else {
    search = CombGaParameters(TrackerParameters().warm);
  }
  if (parameters) std::visit(ParameterReader{*parameters}, warm);
  std::visit(Validator{value.where()}, warm);
  return {shippedFirstGuess(), std::get<SearchMethod>(warm)};
}

ExperimentRow readRow(const YamlValue& value, const std::optional<YamlValue>& common) {
  YamlMap map(value, "a row: name, algorithm, parameters, thesis");
  ExperimentRow row;
  const YamlValue name = map.require("name", "give every row a name of its own");
  row.name = name.text();
  if (row.name.find_first_of(",\"\n") != std::string::npos) name.refuse("a name without commas and quotes");
  if (auto v = map.take("base")) row.base = v->choice(kBases);
  row.method = methodNamed(map.require("algorithm", "name the algorithm, e.g. comb-GA-wl-sh"), row.base);
  const auto* combinatorial = std::get_if<SearchMethod>(&row.method);
  const bool is_genetic =
      std::holds_alternative<ContinuousGeneticParameters>(row.method) ||
      (combinatorial != nullptr && std::holds_alternative<CombGaParameters>(*combinatorial));
  const bool is_shipped = row.base == RowBase::Shipped || row.base == RowBase::ShippedCycles;
  // What is shipped is not what an experiment has in common.
  if (common && is_genetic && !is_shipped) std::visit(ParameterReader{*common}, row.method);
  const std::optional<YamlValue> parameters = map.take("parameters");
  if (parameters) {
    std::visit(ParameterReader{*parameters}, row.method);
    row.has_own_limit = YamlMap(*parameters, "a map of parameters").take("evaluation_limit").has_value();
  }
  if (row.base == RowBase::Thesis) row.motion.guess = thesisFirstGuess();
  if (row.base == RowBase::ShippedCycles) row.motion = shippedMotion(row, value, parameters);
  if (auto v = map.take("inheritance")) row.motion.guess = readFirstGuess(*v, row.motion.guess);
  std::visit(Validator{value.where()}, row.method);
  map.take("thesis");      // the thesis's own figures, for the report
  map.take("variant_of");  // the thesis's row that it improves on
  map.take("reasons");     // why a figure is worse than the thesis's
  map.take("better");      // why one is better
  map.finish();
  return row;
}

/// Points of final populations: of searches over node pairs at one pose, and one kind of points in a file.
void requirePopulations(const Experiment& experiment, const std::optional<YamlValue>& asked) {
  if (!experiment.population_points) return;
  if (experiment.points) {
    asked->fail("points are kept of every run already", "leave out points or population_points");
  }
  for (const ExperimentRow& row : experiment.rows) {
    if (!std::holds_alternative<SearchMethod>(row.method)) {
      asked->fail("the row " + row.name + " has no population of node pairs", "leave out one of them");
    }
  }
  for (const ExperimentScene& scene : experiment.scenes) {
    if (scene.isMotion()) asked->fail("the scene " + scene.name + " is a motion", "give it one instant");
  }
}

}  // namespace

Experiment loadExperiment(const std::string& file) {
  YamlMap map(YamlValue::parse(readText(file), file), "an experiment: title, runs, scenes, rows");
  Experiment experiment;
  experiment.name = std::filesystem::path(file).stem().string();
  experiment.title = map.require("title", "say what the table shows").text();
  map.take("table");
  map.take("figure");
  map.take("columns");
  map.take("layout");
  map.take("remark");
  map.take("note");
  map.take("reasons");
  map.take("better");
  if (auto v = map.take("seed")) experiment.seed = v->count(0, std::numeric_limits<std::uint64_t>::max());
  YamlMap runs(map.require("runs", "say how many runs: {quick: 20, full: 500}"), "{quick: 20, full: 500}");
  experiment.quick_runs = count32(runs.require("quick", "a count"), 1);
  experiment.full_runs = count32(runs.require("full", "a count"), 1);
  runs.finish();
  if (auto v = map.take("niches")) experiment.niches = v->boolean();
  if (auto v = map.take("visible_niches")) experiment.visible_niches = v->boolean();
  if (auto v = map.take("curves")) experiment.curves = v->boolean();
  if (auto v = map.take("points")) experiment.points = v->boolean();
  const std::optional<YamlValue> population_points = map.take("population_points");
  if (population_points) experiment.population_points = population_points->boolean();
  const YamlMap scenes(map.require("scenes", "name scenes and their grids: {battery_static: 0.05}"),
                       "scenes and the edge length of their grids");
  const std::string folder = std::filesystem::path(file).parent_path().string();
  bool all_have_trees = true;
  for (const auto& [name, scene] : scenes.entries()) {
    experiment.scenes.push_back(readScene(name, scene, folder));
    all_have_trees = all_have_trees && !experiment.scenes.back().thesis_scene.empty();
  }
  const std::optional<YamlValue> common = map.take("common");
  std::set<std::string> names;
  for (const YamlValue& value : map.require("rows", "list the rows").list("rows")) {
    experiment.rows.push_back(readRow(value, common));
    if (!names.insert(experiment.rows.back().name).second) {
      value.fail("the name " + experiment.rows.back().name + " stands twice", "give every row its own");
    }
    if (isContinuous(experiment.rows.back().method) && !all_have_trees) {
      value.fail("the continuous approach needs constraint trees", "use scenes of meshes/thesis only");
    }
  }
  map.finish();
  requirePopulations(experiment, population_points);
  return experiment;
}

}  // namespace concave_distance::evaluation
