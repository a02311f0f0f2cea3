#include "scene_spec.h"

#include <algorithm>
#include <map>

#include "body_spec_reader.h"
#include "cloud_spec_reader.h"
#include "concave_distance/base/error.h"
#include "scene/name_pattern.h"
#include "settings_reader.h"
#include "simulation_reader.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint64_t kBytesPerMegabyte = 1'000'000;
constexpr std::uint64_t kMostMegabytes = 1'000'000;
constexpr std::pair<const char*, bool> kSides[] = {{"earlier", false}, {"later", true}};

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

SideSpec readSide(const YamlValue& value) {
  if (!value.isList()) return {{readSelector(value)}, false};
  SideSpec side{{}, true};
  for (const YamlValue& name : value.list("a list of bodies, groups and patterns")) {
    side.names.push_back(readSelector(name));
  }
  if (side.names.empty()) value.refuse("a list of at least one body, group or pattern");
  return side;
}

// Everything of a pair's entry: what the reader of the whole file needs, and the settings.
struct PairEntry : PairSpec {
  std::optional<bool> enabled;
};

// The two sides, and what `earlier` and `later` bring with them.
void readSides(YamlMap& map, PairEntry& entry) {
  const std::optional<YamlValue> earlier = map.take("earlier");
  const std::optional<YamlValue> between = map.take("between");
  if (between && earlier) earlier->fail("'between' is given, too", "give one of them");
  if (between) {
    const char* allowed = "a list of two: each a body, a group, a pattern or a list of these";
    const std::vector<YamlValue> sides = between->list(allowed);
    if (sides.size() != 2) between->refuse(allowed);
    entry.between = {readSide(sides[0]), readSide(sides[1])};
  } else if (earlier) {
    entry.is_ordered = true;
    entry.between = {readSide(*earlier), readSide(map.require("later", "give the other side of 'earlier'"))};
    if (auto v = map.take("body_a")) entry.later_is_a = v->choice(kSides);
  } else {
    map.require("between", "give `between: [<one side>, <other side>]`");
  }
}

PairEntry readEntry(const YamlValue& value, PairSettings& settings) {
  YamlMap map(value, "a map with `between` and settings");
  PairEntry entry;
  readSides(map, entry);
  if (auto v = map.take("watched")) entry.is_watched = v->boolean();
  if (auto v = map.take("name")) {
    entry.name = v->text();
    requirePairName(*v, entry.name);
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
    PairEntry entry = readEntry(item, settings);
    if (!entry.name.empty()) names.add(entry.name, "pair", item.where());
    entry.entry = item;
    pairs.push_back(std::move(entry));
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

}  // namespace

SceneSpec readSceneSpec(const std::string& yaml, const std::string& file, const std::string& base_folder,
                        const SceneLoadOptions& options) {
  YamlMap map(YamlValue::parse(yaml, file), "a map with robots, bodies, clouds, groups, pairs, defaults");
  SceneSpec spec;
  spec.defaults.pairs = options.default_settings;
  spec.metric_memory_limit = options.metric_memory_limit;
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
  if (auto v = map.take("clouds")) {
    for (const YamlValue& item : v->list("a list of clouds")) {
      spec.bodies.push_back(readCloudSpec(item));
      body_names.add(spec.bodies.back().description.name, "cloud", spec.bodies.back().where);
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
