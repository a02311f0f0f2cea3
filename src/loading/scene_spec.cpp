#include "scene_spec.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/ascii.h"
#include "body_spec_reader.h"
#include "concave_distance/base/error.h"
#include "scene/name_pattern.h"
#include "settings_reader.h"
#include "simulation_reader.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint64_t kBytesPerMegabyte = 1'000'000;
constexpr std::uint64_t kMostMegabytes = 1'000'000;

// Names that must not stand twice, with the place where each stood first.
class Names {
 public:
  void add(const std::string& name, const std::string& what, const std::string& where) {
    const auto [same, is_new] = places_.emplace(name, what + " at " + where);
    if (!is_new) {
      throw Error(where, "the name '" + name + "' is taken by the " + same->second, "give another name");
    }
  }

 private:
  std::map<std::string, std::string> places_;
};

Selector readSelector(const YamlValue& value) {
  return {value.where(), value.text()};
}

std::array<Selector, 2> readTwoSelectors(const YamlValue& value) {
  const char* allowed = "a list of two: each a body, a group or a pattern";
  const std::vector<YamlValue> sides = value.list(allowed);
  if (sides.size() != 2) value.refuse(allowed);
  return {readSelector(sides[0]), readSelector(sides[1])};
}

bool isPairName(const std::string& name) {
  const auto allowed = [](char c) { return isLetterOrDigit(c) || c == '_' || c == '/'; };
  return std::all_of(name.begin(), name.end(), allowed) && name.front() != '/' && name.back() != '/' &&
         name.find("//") == std::string::npos;
}

// Everything of a pair's entry: what the reader of the whole file needs, and the settings.
struct PairEntry {
  std::array<Selector, 2> between;
  std::string name;
  std::optional<bool> enabled;
};

PairEntry readEntry(const YamlValue& value, PairSettings& settings) {
  YamlMap map(value, "a map with `between` and settings");
  PairEntry entry;
  entry.between = readTwoSelectors(map.require("between", "give `between: [<one side>, <other side>]`"));
  if (auto v = map.take("name")) {
    entry.name = v->text();
    if (!isPairName(entry.name)) v->refuse("letters, digits, _ and single / in between");
  }
  if (auto v = map.take("enabled")) entry.enabled = v->boolean();
  readPairSettings(map, settings);
  map.finish();
  return entry;
}

std::vector<PairSpec> readPairs(const YamlValue& value, const PairSettings& defaults, Names& names) {
  std::vector<PairSpec> pairs;
  for (const YamlValue& item : value.list("a list of pairs")) {
    PairSettings settings = defaults;
    const PairEntry entry = readEntry(item, settings);
    if (!entry.name.empty()) names.add(entry.name, "pair", item.where());
    pairs.push_back({entry.between, entry.name, item});
  }
  return pairs;
}

std::vector<GroupSpec> readGroups(const YamlValue& value, Names& names) {
  std::vector<GroupSpec> groups;
  const YamlMap map(value, "a map from a group's name to a list of bodies and patterns");
  for (const auto& [name, members] : map.entries()) {
    if (name.empty() || isPattern(name))
      members.fail("'" + name + "' is no name for a group", "leave out * ? [");
    names.add(name, "group", members.where());
    GroupSpec group{members.where(), name, {}};
    for (const YamlValue& member : members.list("a list of bodies, patterns and groups above")) {
      group.members.push_back(readSelector(member));
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

// A folder, relative to that of the scene file, or off.
PreparationCachePointer readCache(const YamlValue& value, const std::string& base_folder) {
  std::string folder = value.text();
  if (folder.empty()) value.refuse("a folder, or off");
  if (folder != "off") folder = (std::filesystem::path(base_folder) / folder).string();
  return openPreparationCache(folder);
}

}  // namespace

SceneSpec readSceneSpec(const std::string& yaml, const std::string& file, const std::string& base_folder,
                        const SceneLoadOptions& options) {
  YamlMap map(YamlValue::parse(yaml, file), "a map with robots, bodies, groups, pairs, defaults");
  SceneSpec spec;
  spec.defaults.pairs = options.default_settings;
  spec.metric_memory_limit = options.metric_memory_limit;
  spec.cache = options.cache;
  BodyDefaults body_defaults;
  body_defaults.geometry = options.geometry;
  if (auto v = map.take("materials")) body_defaults.materials = readMaterials(*v);
  // Before all that they are the defaults of, wherever they stand in the file.
  if (auto v = map.take("defaults")) {
    YamlMap defaults(*v, "a map of settings");
    readPairSettings(defaults, spec.defaults.pairs);
    readBodyDefaults(defaults, body_defaults);
    defaults.finish();
    validatePairSettings(spec.defaults.pairs, v->where());
    spec.defaults.max_edge_length = body_defaults.max_edge_length;
    spec.defaults.chord_error = body_defaults.chord_error;
    spec.defaults.material = body_defaults.material;
  }
  if (auto v = map.take("metric_memory_limit_mb")) {
    spec.metric_memory_limit = v->count(0, kMostMegabytes, "megabytes") * kBytesPerMegabyte;
  }
  if (auto v = map.take("cache")) spec.cache = readCache(*v, base_folder);
  Names body_names;
  if (auto v = map.take("robots")) {
    for (const YamlValue& item : v->list("a list of robots")) {
      spec.robots.push_back(readRobotSpec(item, body_defaults));
      if (const RobotSpec& robot = spec.robots.back(); !robot.name.empty()) {
        body_names.add(robot.name, "robot", robot.where);
      }
    }
  }
  if (auto v = map.take("bodies")) {
    for (const YamlValue& item : v->list("a list of bodies")) {
      spec.bodies.push_back(readBodySpec(item, body_defaults));
      body_names.add(spec.bodies.back().description.name, "body", spec.bodies.back().where);
    }
  }
  if (auto v = map.take("groups")) spec.groups = readGroups(*v, body_names);
  Names pair_names;
  if (auto v = map.take("pairs")) spec.pairs = readPairs(*v, spec.defaults.pairs, pair_names);
  if (auto v = map.take("disable")) {
    for (const YamlValue& item : v->list("a list of pairs")) spec.disabled.push_back(readTwoSelectors(item));
  }
  if (auto v = map.take("simulation")) {
    spec.simulation = readSimulation(*v, base_folder, options.package_locator);
  }
  map.finish();
  return spec;
}

void readPairEntry(const YamlValue& entry, PairSettings& settings, std::optional<bool>& enabled) {
  if (const std::optional<bool> said = readEntry(entry, settings).enabled) enabled = said;
}

}  // namespace concave_distance::detail
