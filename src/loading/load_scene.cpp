#include "concave_distance/loading/load_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "build_bodies.h"
#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "robot_at_rest.h"
#include "robot_description.h"
#include "robot_texts.h"
#include "saved_operations.h"
#include "scene/body_pool.h"
#include "scene/scene_edits.h"
#include "scene_parts.h"
#include "scene_spec.h"
#include "select_pairs.h"
#include "settings_reader.h"
#include "yaml_text.h"

namespace concave_distance {
namespace {

using detail::BuiltBody;
using detail::DescriptionText;
using detail::RobotDescription;
using detail::RobotSpec;
using detail::SceneDocuments;
using detail::SceneParts;
using detail::SceneSpec;

using LinkPairs = std::vector<std::pair<std::string, std::string>>;

// Enough to see what is missing; a list cut short says so.
constexpr std::size_t kMostPairsListed = 10;
constexpr const char* kSemanticDescription = "robot_description_semantic";

// "a/b, a/c and 3 more": the pairs that go with a body that could not be loaded.
std::string lostPairs(const Scene& outline, std::size_t body) {
  std::string text;
  std::size_t count = 0;
  const auto add = [&](const std::string& name) {
    if (count < kMostPairsListed) text += (count == 0 ? "" : ", ") + name;
    ++count;
  };
  for (const ScenePair& pair : outline.pairs) {
    if (pair.body_a == body || pair.body_b == body) add(pair.name);
  }
  for (std::size_t other = 0; other < outline.bodies.size(); ++other) {
    if (const auto pair = ruledPair(outline, body, other)) add(pair->name);
  }
  if (count > kMostPairsListed) text += " and " + std::to_string(count - kMostPairsListed) + " more";
  return count == 0 ? "no pairs are lost with it" : "pairs not served: " + text;
}

bool isOpen(const SceneBody& body) {
  const std::vector<bool>& closed = body.mesh->topology().shell_is_closed;
  return std::find(closed.begin(), closed.end(), false) != closed.end();
}

void noteOpen(Scene& scene, const SceneBody& body, const std::string& pairs) {
  scene.problems.push_back({body.source, "body '" + body.name + "' is not closed: " + pairs +
                                             " no normal force where its open surface is met (close "
                                             "the mesh, see mesh_tool repair)"});
}

// An open surface has no inside, so nothing says how deep another body is in it.
void noteOpenBodies(Scene& scene) {
  for (const ScenePair& pair : scene.pairs) {
    if (!pair.settings.effects.normal_force) continue;
    for (const std::size_t body : {pair.body_a, pair.body_b}) {
      if (isOpen(scene.bodies[body])) noteOpen(scene, scene.bodies[body], "pair '" + pair.name + "' has");
    }
  }
  BodySet with_force;
  for (std::size_t i = 0; i < scene.rules.list.size(); ++i) {
    const PairRule& rule = scene.rules.list[i];
    if (rule.is_watched && settingsOf(scene, rule).effects.normal_force)
      with_force |= scene.rules.bodiesOf(i);
  }
  for (const std::size_t i : with_force.indices()) {
    if (isOpen(scene.bodies[i])) noteOpen(scene, scene.bodies[i], "its pairs have");
  }
}

// A group of the file that has the name of a robot's takes its place.
std::set<std::string> groupsOfRobots(const std::map<std::string, std::vector<std::string>>& groups,
                                     const SceneSpec& spec) {
  std::set<std::string> names;
  for (const auto& group : groups) names.insert(group.first);
  for (const detail::GroupSpec& group : spec.groups) names.erase(group.name);
  return names;
}

// The scene file that loads the scene of one robot.
std::string textOfRobotScene(const RobotSpec& robot, const Scene& scene, const LinkPairs& overlapping) {
  detail::YamlItems items;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) items.add(key, detail::yamlText(value));
  };
  add("description", robot.description);
  if (!robot.urdf.empty()) add("urdf", detail::savedResource(robot.urdf, ""));
  add("semantic_description", robot.semantic_description);
  add("geometry", robot.geometry == GeometrySource::Collision ? "collision" : "visual");
  if (robot.chord_error) items.add("chord_error", detail::yamlNumber(*robot.chord_error));
  std::string text = "robots:\n  - " + items.flow() + "\n";
  if (scene.automatic_cutoff && std::isfinite(*scene.automatic_cutoff))
    text += "defaults: {cutoff: " + detail::yamlNumber(*scene.automatic_cutoff) + "}\n";
  if (!overlapping.empty()) text += "disable:\n";
  for (const auto& [a, b] : overlapping) text += "  - " + detail::yamlTexts({a, b}) + "\n";
  return text;
}

void requireNoProblem(const Scene& scene) {
  if (scene.problems.empty()) return;
  const SceneProblem& first = scene.problems.front();
  const std::size_t others = scene.problems.size() - 1;
  throw Error(first.where, first.message + (others == 0 ? "" : ", and " + std::to_string(others) + " more"),
              "mend it, or load without `strict`: the rest is served then");
}

Scene assemble(const SceneSpec& spec, SceneParts parts, const SceneLoadOptions& options) {
  if (parts.sources.size() > options.limits.bodies) {
    throw Error("scene", std::to_string(parts.sources.size()) + " bodies",
                "the limit is " + std::to_string(options.limits.bodies) + " (largest_body_count)");
  }
  // Before the costly part, so that a mistake in the file is reported at once.
  const Scene outline = detail::outlineOf(spec, parts, options.limits.pairs);
  detail::limitImports(parts, options.mesh_import);
  for (detail::BodySource& source : parts.sources) {
    if (source.cloud && !options.clouds) source.problem = "nobody receives it";
  }
  Scene scene = outline;
  scene.pool = options.pool ? options.pool : std::make_shared<BodyPool>(spec.metric_memory_limit);
  scene.limits = options.limits;
  std::vector<BuiltBody> built = detail::buildBodies(
      parts.sources,
      {options.package_locator, options.mesh_search_path, scene.pool, options.limits, options.progress});
  scene.simulation = spec.simulation;
  scene.robots = parts.robots;
  scene.groups_of_robots = groupsOfRobots(scene.groups, spec);
  scene.notes = std::move(parts.notes);
  scene.warnings = std::move(parts.warnings);
  scene.problems = std::move(parts.problems);
  scene.problems.insert(scene.problems.end(), outline.problems.begin(), outline.problems.end());
  std::vector<bool> is_lost(built.size(), false);
  for (std::size_t i = 0; i < built.size(); ++i) {
    for (const std::string& note : built[i].notes) scene.notes.push_back(parts.sources[i].name + ": " + note);
    if (built[i].body) {
      built[i].body->label = outline.bodies[i].label;
      scene.bodies.edit(i) = std::move(*built[i].body);
      continue;
    }
    is_lost[i] = true;
    if (parts.sources[i].cloud && !options.clouds) {
      scene.warnings.push_back("cloud '" + parts.sources[i].name +
                               "' is left out, because only the node receives clouds");
    } else {
      scene.problems.push_back({parts.sources[i].source, "body '" + parts.sources[i].name +
                                                             "' is not served: " + built[i].problem + "; " +
                                                             lostPairs(outline, i)});
    }
  }
  takeOutBodies(scene, is_lost);
  noteOpenBodies(scene);
  scene.notes.insert(scene.notes.end(), outline.notes.begin(), outline.notes.end());
  return scene;
}

}  // namespace

Scene loadSceneText(const std::string& yaml, const std::string& where, const std::string& base_folder,
                    const SceneLoadOptions& options) {
  const SceneDocuments documents = detail::readSceneDocuments(yaml, where, base_folder);
  const std::string& folder = documents.folder;
  const SceneSpec spec = detail::readSceneSpec(documents.scene, where, folder, options);
  SceneParts parts;
  for (const RobotSpec& robot : spec.robots) detail::readRobot(robot, folder, options, parts);
  for (const detail::BodySpec& body : spec.bodies) detail::addBody(body, folder, parts);
  Scene scene = assemble(spec, parts, options);
  detail::limitManyPairs(scene);
  detail::applySaved(documents.operations, base_folder, options, scene);
  scene.file = std::make_shared<const SceneText>(
      SceneText{documents.scene, detail::savedResource(folder, ""), std::move(scene.operations)});
  scene.operations.clear();
  if (options.strict) requireNoProblem(scene);
  return scene;
}

Scene loadSceneFile(const std::string& path, const SceneLoadOptions& options) {
  return loadSceneText(detail::readTextFile(path, "scene file"), path, detail::folderOf(path), options);
}

std::vector<std::string> descriptionsOfSceneFile(const std::string& path) {
  const std::string text = detail::sceneTextOf(detail::readTextFile(path, "scene file"));
  const SceneSpec spec = detail::readSceneSpec(text, path, detail::folderOf(path), SceneLoadOptions{});
  std::vector<std::string> names;
  for (const RobotSpec& robot : spec.robots) {
    for (const std::string& name : {robot.description, robot.semantic_description}) {
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

Scene loadRobotScene(const std::string& urdf, const std::string& where, const SceneLoadOptions& options) {
  SceneSpec spec;
  spec.defaults.pairs = options.default_settings;
  spec.metric_memory_limit = options.metric_memory_limit;
  detail::validatePairSettings(spec.defaults.pairs, where);
  RobotSpec robot;
  robot.where = where;
  robot.geometry = options.geometry;
  robot.chord_error = options.chord_error;
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(where, ignored);
  // A text that comes from no file is what the parameter robot_description holds, and rviz draws it.
  (is_file ? robot.urdf : robot.description) = where;
  SceneParts parts;
  const DescriptionText text{urdf, where, is_file ? detail::folderOf(where) : std::string()};
  const RobotDescription description = detail::readRobotDescription(text.text, text.where, robot.geometry);
  detail::addRobot(robot, description, text, parts);
  if (options.descriptions.count(kSemanticDescription) != 0) {
    robot.semantic_description = kSemanticDescription;
    detail::readSemantics(robot, description, "", options, parts);
    if (!is_file) robot.semantic_description = where + "_semantic";  // as requests name it
  }
  Scene scene = assemble(spec, parts, options);
  if (options.automatic_cutoff) detail::setAutomaticCutoff(scene);
  detail::limitManyPairs(scene);
  detail::warnOfNoGeometry(scene, description, options.geometry);
  const LinkPairs overlapping = detail::reportOverlappingPairs(scene, options);
  scene.file =
      std::make_shared<const SceneText>(SceneText{textOfRobotScene(robot, scene, overlapping), "", {}});
  if (options.strict) requireNoProblem(scene);
  return scene;
}

}  // namespace concave_distance
