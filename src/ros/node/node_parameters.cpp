#include "node_parameters.h"

#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "node_parameter_table.h"
#include "parameter_reader.h"
#include "scene/pair_parameters.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance {
namespace {

/// Parameters that had another name, and what to write instead.
constexpr std::pair<const char*, const char*> kRenamed[] = {
    {"cold_population_size", "expert/cold/population_size"},
    {"cold_generations", "expert/cold/max_generations"},
    {"warm_population_size", "expert/warm/population_size"},
    {"warm_generations", "expert/warm/max_generations"},
    {"immigrants", "expert/random_starts"},
    {"keep_through_material", "expert/keep_through_material"}};

void refuseRenamed(ParameterReader& reader) {
  for (const auto& [name, now] : kRenamed) {
    if (reader.has(name)) {
      throw Error(std::string("~") + name, "the parameter has another name", std::string("set ~") + now);
    }
  }
}

// "a:b", as the shell writes lists of paths.
std::vector<std::string> splitPaths(const std::string& text) {
  std::vector<std::string> paths;
  std::istringstream stream(text);
  for (std::string path; std::getline(stream, path, ':');) {
    if (!path.empty()) {
      paths.push_back(path);
    }
  }
  return paths;
}

void readExperts(ParameterReader& reader, NodeParameters& parameters) {
  PairSettings& pair = parameters.pair;
  ParameterReader experts = reader.group("expert");
  experts.read(nodeParameterTable(), true, parameters);
  experts.read(pairParameters(), true, pair);
  for (const bool cold : {true, false}) {
    const std::string name = cold ? "cold" : "warm";
    ParameterReader genetic = experts.group(name);
    GeneticParameters& search = cold ? pair.tracker.cold : pair.tracker.warm;
    genetic.read(geneticParameters(), false, search);
    search.validate("~expert/" + name);
    experts.adoptUnread(genetic, name + "/");
  }
  reader.adoptUnread(experts, "expert/");
}

// This share of the period leaves time for messages and markers before the next cycle is due.
constexpr double kUsualBudget = 0.8;

void checkMarkers(const MarkerStyle& style) {
  if (style.far != 0.0 && style.far <= style.near) {
    throw Error("~marker_far", "the value is " + toText(style.far),
                "allowed: more than ~marker_near, which is " + toText(style.near) + ", or auto");
  }
}

/// By default every package and the scene file's folder.
MeshRoots meshRoots(const NodeParameters& parameters) {
  std::vector<std::string> entries{"package://"};
  if (parameters.mesh_roots) {
    entries = *parameters.mesh_roots;
  } else if (!parameters.scene_file.empty()) {
    entries.push_back(std::filesystem::absolute(parameters.scene_file).parent_path().string());
  }
  return parseMeshRoots(entries, "~mesh_roots");
}

// The scene file's folder is the default; an empty name means that nothing may be saved.
std::string saveFolder(const NodeParameters& parameters) {
  if (parameters.save_folder == "off") return "";
  if (!parameters.save_folder.empty() || parameters.scene_file.empty()) return parameters.save_folder;
  return std::filesystem::absolute(parameters.scene_file).parent_path().string();
}

MeshImportLimits importLimits(const NodeLimits& limits) {
  MeshImportLimits import;
  import.memory = limits.import_memory_mb * std::size_t{1'000'000};
  import.seconds = limits.import_seconds;
  import.largest_triangle_count = limits.largest_triangle_count;
  return import;
}

}  // namespace

double cycleBudget(const std::optional<double>& budget, double rate) {
  const double period = 1.0 / rate;
  if (!budget) return kUsualBudget * period;
  if (*budget == 0.0) return std::numeric_limits<double>::infinity();
  if (*budget > period) {
    throw Error("~cycle_budget",
                "it is " + toText(*budget) + " s, longer than the period of " + toText(period) +
                    " s (~rate " + toText(rate) + ")",
                "set at most the period, auto (0.8 of it), 0 for cycles without an end, or a lower ~rate");
  }
  return *budget;
}

NodeParameters parseNodeParameters(const XmlRpc::XmlRpcValue& values, std::vector<std::string>& unknown) {
  ParameterReader reader(values, "~");
  refuseRenamed(reader);
  NodeParameters parameters;
  reader.read(nodeParameterTable(), false, parameters);
  if (parameters.robot_description.find('<') != std::string::npos) {
    // Not a name but the URDF itself, in the node's own namespace: it is found there under the usual name.
    parameters.robot_description = NodeParameters().robot_description;
  }
  parameters.reference_frame = requireFrameName(parameters.reference_frame, "~reference_frame");
  parameters.mesh_search_folders = splitPaths(parameters.mesh_search_path);
  parameters.automatic_cutoff = parameters.scene_file.empty() && !reader.has("cutoff");
  reader.read(pairParameters(), false, parameters.pair);
  readExperts(reader, parameters);
  checkMarkers(parameters.marker);
  cycleBudget(parameters.cycle_budget, parameters.rate);
  ParameterReader limits = reader.group("limits");
  limits.read(limitParameters(), false, parameters.limits);
  reader.adoptUnread(limits, "limits/");
  parameters.save_folder = saveFolder(parameters);
  parameters.mesh_access = {importLimits(parameters.limits), meshRoots(parameters)};
  unknown = reader.unread({});
  return parameters;
}

}  // namespace concave_distance
