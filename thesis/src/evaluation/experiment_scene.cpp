#include "experiment_scene.h"

#include <filesystem>
#include <limits>

#include "experiment_values.h"
#include "loading/yaml_value.h"

namespace concave_distance::evaluation {
namespace {

using detail::count32;
using detail::kLength;
using detail::positiveFinite;
using detail::YamlMap;
using detail::YamlValue;

constexpr std::pair<const char*, NodeSource> kNodeSources[] = {
    {"mesh", NodeSource::Mesh},
    {"random_points", NodeSource::RandomPoints},
    {"plain_random_points", NodeSource::PlainRandomPoints},
    {"volume", NodeSource::Volume}};

Instants readInstants(const YamlValue& value) {
  YamlMap map(value, "which poses of the file: {first: 0, count: 40, step: 1}");
  Instants instants;
  if (auto v = map.take("first")) instants.first = count32(*v, 0);
  if (auto v = map.take("count")) instants.count = count32(*v, 1);
  if (auto v = map.take("step")) instants.step = count32(*v, 1);
  map.finish();
  return instants;
}

void readBodies(YamlMap& map, const std::string& folder, ExperimentScene& scene) {
  const auto file = [&](const YamlValue& value) {
    return (std::filesystem::path(folder) / value.text()).string();
  };
  if (auto v = map.take("thesis_scene")) {
    scene.thesis_scene = v->text();
    return;
  }
  scene.mesh_a = file(map.require("mesh_a", "name the mesh file of body A, or a thesis_scene"));
  scene.mesh_b = file(map.require("mesh_b", "name the mesh file of body B"));
  scene.poses = file(map.require("poses", "name a file of poses of B in A's frame"));
  if (auto v = map.take("instants")) scene.instants = readInstants(*v);
}

}  // namespace

ExperimentScene readScene(const std::string& name, const YamlValue& value, const std::string& folder) {
  ExperimentScene scene;
  scene.name = name;
  if (!value.isMap()) {
    scene.thesis_scene = name;
    scene.max_edge_length = value.number(kLength, positiveFinite);
    return scene;
  }
  YamlMap map(value, "a scene: its bodies and their pose or motion");
  readBodies(map, folder, scene);
  if (auto v = map.take("max_edge_length")) {
    scene.max_edge_length = detail::optionalNumber(*v, "auto", kLength, positiveFinite);
  }
  if (auto v = map.take("nodes")) scene.nodes = v->choice(kNodeSources);
  if (scene.nodes != NodeSource::Mesh && !scene.max_edge_length) {
    value.fail("nodes that are no mesh need max_edge_length",
               "say how far apart they are; random points are as many as the grid's nodes would be");
  }
  if (auto v = map.take("node_seed"))
    scene.node_seed = v->count(0, std::numeric_limits<std::uint64_t>::max());
  if (auto v = map.take("lattice_edge")) scene.lattice_edge = v->number(kLength, positiveFinite);
  if (auto v = map.take("evaluation_limit")) {
    scene.evaluation_limit = v->count(1, std::numeric_limits<std::uint64_t>::max());
  }
  if (auto v = map.take("population_size")) scene.population_size = count32(*v, 2, detail::kMost32, "even");
  map.finish();
  return scene;
}

}  // namespace concave_distance::evaluation
