#include "experiment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "concave_distance/base/error.h"
#include "search_settings_reader.h"

namespace concave_distance::evaluation {
namespace {

using detail::YamlMap;
using detail::YamlValue;

constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();

std::string readText(const std::string& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(file, "cannot be opened", "name an experiment file, e.g. experiments/table_5_9.yaml");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// comb-{GA|SA}-{wl|nl|bw}[-sh|-ds|-dc|-dcs|-sc] or multi-start.
SearchMethod methodNamed(const YamlValue& value, const SearchMethod& genetic_base) {
  const std::string name = value.text();
  if (name == "multi-start") return MultiStartParameters{};
  for (const bool local : {true, false}) {
    AnnealingParameters annealing;
    annealing.local_optimization = local;
    if (nameOf(SearchMethod(annealing)) == name) return annealing;
  }
  GeneticParameters genetic = std::get<GeneticParameters>(genetic_base);
  for (const auto local :
       {LocalOptimization::None, LocalOptimization::Lamarckian, LocalOptimization::Baldwinian}) {
    for (const auto niching :
         {NichingMethod::None, NichingMethod::Sharing, NichingMethod::DynamicSharing,
          NichingMethod::DeterministicCrowding, NichingMethod::DeterministicCrowdingWithSelection,
          NichingMethod::SimpleCrowding}) {
      genetic.local_optimization = local;
      genetic.niching = niching;
      if (nameOf(SearchMethod(genetic)) == name) return genetic;
    }
  }
  value.refuse(
      "comb-GA-wl, -nl or -bw, with -sh, -ds, -dc, -dcs or -sc or without; comb-SA-wl or -nl; multi-start");
}

void readParameters(const YamlValue& value, SearchMethod& method) {
  if (auto* genetic = std::get_if<GeneticParameters>(&method)) {
    detail::readGeneticParameters(value, *genetic);
  } else if (auto* annealing = std::get_if<AnnealingParameters>(&method)) {
    detail::readAnnealingParameters(value, *annealing);
  } else {
    YamlMap map(value, "a map of parameters of random starts");
    auto& starts = std::get<MultiStartParameters>(method);
    if (auto v = map.take("starts")) starts.starts = static_cast<std::uint32_t>(v->count(1, kMost32));
    if (auto v = map.take("evaluation_limit")) {
      starts.evaluation_limit = v->count(0, std::numeric_limits<std::uint64_t>::max());
    }
    map.finish();
  }
}

constexpr std::pair<const char*, bool> kBases[] = {{"thesis", true}, {"shipped", false}};

ExperimentRow readRow(const YamlValue& value, const std::optional<YamlValue>& common) {
  YamlMap map(value, "a row: name, algorithm, parameters, thesis");
  ExperimentRow row;
  const YamlValue name = map.require("name", "give every row a name of its own");
  row.name = name.text();
  if (row.name.find_first_of(",\"\n") != std::string::npos) name.refuse("a name without commas and quotes");
  bool from_thesis = true;
  if (auto v = map.take("base")) from_thesis = v->choice(kBases);
  row.method = methodNamed(map.require("algorithm", "name the algorithm, e.g. comb-GA-wl-sh"),
                           from_thesis ? thesisGeneticParameters() : GeneticParameters());
  if (common && std::holds_alternative<GeneticParameters>(row.method)) readParameters(*common, row.method);
  if (auto v = map.take("parameters")) readParameters(*v, row.method);
  if (const auto* genetic = std::get_if<GeneticParameters>(&row.method)) genetic->validate(value.where());
  if (const auto* annealing = std::get_if<AnnealingParameters>(&row.method)) {
    annealing->validate(value.where());
  }
  map.take("thesis");      // the thesis's own figures, for the report
  map.take("variant_of");  // the thesis's row that it improves on
  map.finish();
  return row;
}

}  // namespace

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
  experiment.quick_runs = static_cast<std::uint32_t>(runs.require("quick", "a count").count(1, kMost32));
  experiment.full_runs = static_cast<std::uint32_t>(runs.require("full", "a count").count(1, kMost32));
  runs.finish();
  if (auto v = map.take("niches")) experiment.niches = v->boolean();
  if (auto v = map.take("curves")) experiment.curves = v->boolean();
  const YamlMap scenes(map.require("scenes", "name scenes and their grids: {battery_static: 0.05}"),
                       "scenes and the edge length of their grids");
  for (const auto& [name, edge] : scenes.entries()) {
    experiment.scenes.push_back({name, edge.number("an edge length greater than 0, metres",
                                                   [](double x) { return x > 0.0 && std::isfinite(x); })});
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
