#include "experiment.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "concave_distance/base/error.h"
#include "search_settings_reader.h"
#include "setting_values.h"

namespace concave_distance::evaluation {
namespace {

using detail::count32;
using detail::kLength;
using detail::kShare;
using detail::notNegativeFinite;
using detail::positiveFinite;
using detail::share;
using detail::YamlMap;
using detail::YamlValue;

std::string readText(const std::string& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(file, "cannot be opened", "name an experiment file, e.g. experiments/table_5_9.yaml");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Every method of a family whose name it is tried by.
std::optional<SearchMethod> combinatorialNamed(const std::string& name, GeneticParameters genetic) {
  if (name == "multi-start") return MultiStartParameters{};
  for (const bool local : {true, false}) {
    AnnealingParameters annealing;
    annealing.local_optimization = local;
    if (concave_distance::nameOf(SearchMethod(annealing)) == name) return annealing;
  }
  for (const auto local :
       {LocalOptimization::None, LocalOptimization::Lamarckian, LocalOptimization::Baldwinian}) {
    for (const auto niching :
         {NichingMethod::None, NichingMethod::Sharing, NichingMethod::DynamicSharing,
          NichingMethod::DeterministicCrowding, NichingMethod::DeterministicCrowdingWithSelection,
          NichingMethod::SimpleCrowding}) {
      genetic.local_optimization = local;
      genetic.niching = niching;
      if (concave_distance::nameOf(SearchMethod(genetic)) == name) return genetic;
    }
  }
  return std::nullopt;
}

Method methodNamed(const YamlValue& value, bool from_thesis) {
  const std::string name = value.text();
  for (const bool local : {true, false}) {
    ContinuousGeneticParameters genetic =
        from_thesis ? thesisContinuousGenetic() : improvedContinuousGenetic();
    ContinuousAnnealingParameters annealing =
        from_thesis ? thesisContinuousAnnealing() : improvedContinuousAnnealing();
    genetic.local_step.enabled = annealing.local_step.enabled = local;
    if (nameOf(Method(genetic)) == name) return genetic;
    if (nameOf(Method(annealing)) == name) return annealing;
  }
  const std::optional<SearchMethod> combinatorial =
      combinatorialNamed(name, from_thesis ? thesisGeneticParameters() : GeneticParameters());
  if (combinatorial) return *combinatorial;
  value.refuse(
      "comb-GA-wl, -nl or -bw, with -sh, -ds, -dc, -dcs or -sc or without; comb-SA-wl or -nl; multi-start; "
      "cont-GA-wl or -nl; cont-SA-wl or -nl");
}

void readContinuousGenetic(const YamlValue& value, ContinuousGeneticParameters& p) {
  YamlMap map(value, "a map of parameters of cont-GA");
  if (auto v = map.take("population_size")) p.population_size = count32(*v, 2);
  if (auto v = map.take("max_generations")) p.max_generations = count32(*v, 0);
  if (auto v = map.take("crossover_probability")) p.crossover_probability = v->number(kShare, share);
  if (auto v = map.take("mutation_probability")) p.mutation_probability = v->number(kShare, share);
  if (auto v = map.take("penalty_weight"))
    p.penalty_weight = v->number("0 or more, finite", notNegativeFinite);
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

void readMultiStart(const YamlValue& value, MultiStartParameters& p) {
  YamlMap map(value, "a map of parameters of random starts");
  if (auto v = map.take("starts")) p.starts = count32(*v, 1);
  if (auto v = map.take("evaluation_limit")) {
    p.evaluation_limit = v->count(0, std::numeric_limits<std::uint64_t>::max());
  }
  map.finish();
}

/// Reads the parameters of whatever method it is.
struct ParameterReader {
  const YamlValue& value;
  void operator()(GeneticParameters& p) const { detail::readGeneticParameters(value, p); }
  void operator()(AnnealingParameters& p) const { detail::readAnnealingParameters(value, p); }
  void operator()(MultiStartParameters& p) const { readMultiStart(value, p); }
  void operator()(SearchMethod& method) const { std::visit(*this, method); }
  void operator()(ContinuousGeneticParameters& p) const { readContinuousGenetic(value, p); }
  void operator()(ContinuousAnnealingParameters& p) const { readContinuousAnnealing(value, p); }
};

struct Validator {
  const std::string where;
  void operator()(const MultiStartParameters&) const {}
  void operator()(const SearchMethod& method) const { std::visit(*this, method); }
  template <typename Parameters>
  void operator()(const Parameters& parameters) const {
    parameters.validate(where);
  }
};

constexpr std::pair<const char*, bool> kBases[] = {{"thesis", true}, {"shipped", false}};

ExperimentRow readRow(const YamlValue& value, const std::optional<YamlValue>& common) {
  YamlMap map(value, "a row: name, algorithm, parameters, thesis");
  ExperimentRow row;
  const YamlValue name = map.require("name", "give every row a name of its own");
  row.name = name.text();
  if (row.name.find_first_of(",\"\n") != std::string::npos) name.refuse("a name without commas and quotes");
  bool from_thesis = true;
  if (auto v = map.take("base")) from_thesis = v->choice(kBases);
  row.method = methodNamed(map.require("algorithm", "name the algorithm, e.g. comb-GA-wl-sh"), from_thesis);
  const auto* combinatorial = std::get_if<SearchMethod>(&row.method);
  const bool is_genetic =
      std::holds_alternative<ContinuousGeneticParameters>(row.method) ||
      (combinatorial != nullptr && std::holds_alternative<GeneticParameters>(*combinatorial));
  if (common && is_genetic) std::visit(ParameterReader{*common}, row.method);
  if (auto v = map.take("parameters")) std::visit(ParameterReader{*v}, row.method);
  std::visit(Validator{value.where()}, row.method);
  map.take("thesis");      // the thesis's own figures, for the report
  map.take("variant_of");  // the thesis's row that it improves on
  map.finish();
  return row;
}

}  // namespace

std::string nameOf(const Method& method) {
  if (const auto* genetic = std::get_if<ContinuousGeneticParameters>(&method)) {
    return genetic->local_step.enabled ? "cont-GA-wl" : "cont-GA-nl";
  }
  if (const auto* annealing = std::get_if<ContinuousAnnealingParameters>(&method)) {
    return annealing->local_step.enabled ? "cont-SA-wl" : "cont-SA-nl";
  }
  return concave_distance::nameOf(std::get<SearchMethod>(method));
}

GeneticParameters thesisGeneticParameters() {
  GeneticParameters parameters;
  parameters.exchange_probability = 0.0;
  parameters.immigrants = 0;
  parameters.conserve_niches = false;
  parameters.fitness_epsilon = 0.0;
  return parameters;
}

Experiment loadExperiment(const std::string& file) {
  YamlMap map(YamlValue::parse(readText(file), file), "an experiment: title, runs, scenes, rows");
  Experiment experiment;
  experiment.name = std::filesystem::path(file).stem().string();
  experiment.title = map.require("title", "say what the table shows").text();
  map.take("table");
  map.take("figure");
  map.take("columns");
  map.take("remark");
  if (auto v = map.take("seed")) experiment.seed = v->count(0, std::numeric_limits<std::uint64_t>::max());
  YamlMap runs(map.require("runs", "say how many runs: {quick: 20, full: 500}"), "{quick: 20, full: 500}");
  experiment.quick_runs = count32(runs.require("quick", "a count"), 1);
  experiment.full_runs = count32(runs.require("full", "a count"), 1);
  runs.finish();
  if (auto v = map.take("niches")) experiment.niches = v->boolean();
  if (auto v = map.take("curves")) experiment.curves = v->boolean();
  const YamlMap scenes(map.require("scenes", "name scenes and their grids: {battery_static: 0.05}"),
                       "scenes and the edge length of their grids");
  for (const auto& [name, edge] : scenes.entries()) {
    experiment.scenes.push_back({name, edge.number(kLength, positiveFinite)});
  }
  const std::optional<YamlValue> common = map.take("common");
  std::set<std::string> names;
  for (const YamlValue& value : map.require("rows", "list the rows").list("rows")) {
    experiment.rows.push_back(readRow(value, common));
    if (!names.insert(experiment.rows.back().name).second) {
      value.fail("the name " + experiment.rows.back().name + " stands twice", "give every row its own");
    }
  }
  map.finish();
  return experiment;
}

}  // namespace concave_distance::evaluation
