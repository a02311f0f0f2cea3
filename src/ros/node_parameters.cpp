#include "concave_distance/ros/node_parameters.h"

#include <array>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

#include "concave_distance/base/error.h"
#include "concave_distance/ros/parameter_reader.h"
#include "concave_distance/ros/tf_poses.h"
#include "concave_distance/scene/frame_name.h"

namespace concave_distance {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Above any length of a scene; keeps a misplaced exponent out.
constexpr double kLongest = 1e6;
constexpr double kLeastForce = 1e-6;  // newtons a metre of an arrow
constexpr double kLargestForce = 1e12;

// Individuals of a generation are mated in pairs.
std::uint32_t requireEven(const std::string& name, std::uint32_t count) {
  if (count % 2 != 0) {
    throw Error("~" + name, "the value is " + std::to_string(count), "allowed: an even number");
  }
  return count;
}

TrackerParameters readTracker(ParameterReader& reader, TrackerParameters tracker) {
  constexpr std::array<AccuracyLevel, 4> kLevels = {AccuracyLevel::Nodes, AccuracyLevel::Refined,
                                                    AccuracyLevel::Certified, AccuracyLevel::Complete};
  std::vector<std::string> names;
  for (const AccuracyLevel level : kLevels) {
    names.emplace_back(toString(level));
  }
  tracker.accuracy = kLevels[reader.choice("accuracy", static_cast<std::size_t>(tracker.accuracy), names)];
  tracker.absolute_tolerance = reader.number("absolute_tolerance", tracker.absolute_tolerance, 0.0, kLongest);
  tracker.relative_tolerance = reader.number("relative_tolerance", tracker.relative_tolerance, 0.0, 1.0);
  const double budget = reader.number("time_budget", 0.0, 0.0, kLongest);
  tracker.time_budget = budget == 0.0 ? kInfinity : budget;
  const double cutoff = reader.number("cutoff", 0.0, 0.0, kLongest);
  tracker.cutoff = cutoff == 0.0 ? kInfinity : cutoff;
  tracker.least_prominence = reader.number("least_prominence", tracker.least_prominence, 0.0, 1e3);
  tracker.largest_niche_count = reader.count("largest_niche_count", tracker.largest_niche_count, 1, 100'000);
  tracker.keep_through_material = reader.flag("keep_through_material", tracker.keep_through_material);
  tracker.extrapolate = reader.flag("extrapolate", tracker.extrapolate);
  tracker.cold.population_size =
      requireEven("cold_population_size",
                  reader.count("cold_population_size", tracker.cold.population_size, 2, 1'000'000));
  tracker.cold.max_generations = reader.count("cold_generations", tracker.cold.max_generations, 0, 1'000'000);
  tracker.warm.population_size = requireEven(
      "warm_population_size", reader.count("warm_population_size", tracker.warm.population_size, 2, 10'000));
  tracker.warm.max_generations = reader.count("warm_generations", tracker.warm.max_generations, 0, 10'000);
  tracker.immigrants = reader.count("immigrants", tracker.immigrants, 0, 10'000);
  tracker.seed = reader.count("seed", static_cast<std::uint32_t>(tracker.seed), 0, 2'147'483'647);
  tracker.validate("~");
  return tracker;
}

PairSettings readPair(ParameterReader& reader, PairSettings pair) {
  pair.tracker = readTracker(reader, pair.tracker);
  if (reader.has("warning_distance")) {
    pair.warning_distance = reader.number("warning_distance", 0.0, 0.0, kLongest);
  }
  pair.warning_hysteresis = reader.number("warning_hysteresis", pair.warning_hysteresis, 0.0, kLongest);
  return pair;
}

// "a:b", as the shell writes lists of paths.
std::vector<std::string> readPaths(const std::string& text) {
  std::vector<std::string> paths;
  std::istringstream stream(text);
  for (std::string path; std::getline(stream, path, ':');) {
    if (!path.empty()) {
      paths.push_back(path);
    }
  }
  return paths;
}

MarkerStyle readMarkers(ParameterReader& reader, MarkerStyle style) {
  style.scale = reader.number("marker_scale", style.scale, 0.0, kLongest);
  style.near = reader.number("marker_near", style.near, 0.0, kLongest);
  style.far = reader.number("marker_far", style.far, 0.0, kLongest);
  style.force_scale = reader.number("force_marker_scale", style.force_scale, kLeastForce, kLargestForce);
  style.pair_count = reader.count("marker_pair_count", style.pair_count, 0, 1'000'000);
  style.niche_count = reader.count("marker_niche_count", style.niche_count, 0, 1'000'000);
  style.legend = reader.flag("show_legend", style.legend);
  if (style.far != 0.0 && style.far <= style.near) {
    throw Error(
        "~marker_far", "the value is " + std::to_string(style.far),
        "allowed: more than ~marker_near, which is " + std::to_string(style.near) + ", or 0 for automatic");
  }
  return style;
}

/// By default every package and the scene file's folder.
MeshRoots readMeshRoots(ParameterReader& reader, const std::string& scene_file) {
  std::vector<std::string> entries{"package://"};
  if (reader.has("mesh_roots")) {
    entries = reader.texts("mesh_roots");
  } else if (!scene_file.empty()) {
    entries.push_back(std::filesystem::absolute(scene_file).parent_path().string());
  }
  return parseMeshRoots(entries, "~mesh_roots");
}

MeshImportLimits importLimits(const NodeLimits& limits) {
  MeshImportLimits import;
  import.memory = limits.import_memory_mb * std::size_t{1'000'000};
  import.seconds = limits.import_seconds;
  import.largest_triangle_count = limits.largest_triangle_count;
  return import;
}

}  // namespace

NodeParameters parseNodeParameters(XmlRpc::XmlRpcValue values, std::vector<std::string>& unknown) {
  ParameterReader reader(std::move(values), "~");
  NodeParameters parameters;
  parameters.scene_file = reader.text("scene_file", parameters.scene_file);
  parameters.robot_description = reader.text("robot_description", parameters.robot_description);
  if (parameters.robot_description.find('<') != std::string::npos) {
    // Not a name but the URDF itself, in the node's own namespace: it is found there under the usual name.
    parameters.robot_description = NodeParameters().robot_description;
  }
  parameters.reference_frame =
      requireFrameName(reader.text("reference_frame", parameters.reference_frame), "~reference_frame");
  parameters.geometry = reader.choice("geometry", 0, {"collision", "visual"}) == 0 ? GeometrySource::Collision
                                                                                   : GeometrySource::Visual;
  parameters.mesh_search_path = readPaths(reader.text("mesh_search_path", ""));
  parameters.cache = reader.text("cache", parameters.cache);
  parameters.rate = reader.number("rate", parameters.rate, 0.1, 2000.0);
  parameters.marker_rate = reader.number("marker_rate", parameters.marker_rate, 0.1, 200.0);
  parameters.threads = reader.count("threads", parameters.threads, 0, 1024);
  parameters.transform_timeout = reader.number("transform_timeout", parameters.transform_timeout, 0.0, 60.0);
  parameters.stale_after = reader.number("stale_after", parameters.stale_after, 1e-3, 1e6);
  parameters.tf_cache = reader.number("tf_cache", parameters.tf_cache, 0.1, 3600.0);
  parameters.tf_future_tolerance =
      reader.number("tf_future_tolerance", parameters.tf_future_tolerance, 0.0, 60.0);
  parameters.automatic_cutoff = parameters.scene_file.empty() && !reader.has("cutoff");
  parameters.skip_overlapping_pairs =
      reader.flag("skip_overlapping_pairs", parameters.skip_overlapping_pairs);
  parameters.pair = readPair(reader, parameters.pair);
  parameters.publish_markers = reader.flag("publish_markers", parameters.publish_markers);
  parameters.publish_contact_markers =
      reader.flag("publish_contact_markers", parameters.publish_contact_markers);
  parameters.show_bodies = reader.flag("show_bodies", parameters.show_bodies);
  if (reader.has("pair_topics")) {
    parameters.pair_topics = reader.texts("pair_topics");
  }
  parameters.marker = readMarkers(reader, parameters.marker);
  parameters.limits = readLimits(reader);
  parameters.mesh_access = {importLimits(parameters.limits), readMeshRoots(reader, parameters.scene_file)};
  parameters.diagnostic_period =
      reader.number("diagnostic_period", parameters.diagnostic_period, 0.05, 3600.0);
  unknown = reader.unread({});
  return parameters;
}

}  // namespace concave_distance
