#include "concave_distance/ros/scene_edits.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

std::string freePairName(const Scene& scene, const std::string& wanted) {
  std::string name = wanted;
  const auto taken = [&] {
    return std::any_of(scene.pairs.begin(), scene.pairs.end(),
                       [&](const ScenePair& pair) { return pair.name == name; });
  };
  for (int copy = 2; taken(); ++copy) {
    name = wanted + "_" + std::to_string(copy);
  }
  return name;
}

const std::string& appendPair(Scene& scene, std::size_t body_a, std::size_t body_b,
                              const PairSettings& settings) {
  ScenePair pair;
  pair.name = freePairName(scene, scene.bodies[body_a].name + "/" + scene.bodies[body_b].name);
  pair.body_a = body_a;
  pair.body_b = body_b;
  pair.settings = settings;
  scene.pairs.push_back(std::move(pair));
  return scene.pairs.back().name;
}

}  // namespace

bool isRosName(const std::string& name) {
  bool part_begins = true;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (c == '/' ? part_begins : std::isalnum(letter) == 0 && c != '_') {
      return false;
    }
    part_begins = c == '/';
  }
  return !part_begins && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
}

std::size_t requireBody(const Scene& scene, const std::string& name) {
  const auto found = scene.findBody(name);
  if (!found) {
    throw Error("body", "there is no body '" + name + "'", "list_bodies tells their names");
  }
  return *found;
}

std::size_t requirePair(const Scene& scene, const std::string& name) {
  for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
    if (scene.pairs[index].name == name) {
      return index;
    }
  }
  throw Error("pair", "there is no pair '" + name + "'", "list_bodies tells their names");
}

std::vector<std::string> addBody(Scene& scene, SceneBody body, const std::vector<std::string>& pair_with,
                                 const PairSettings& settings) {
  if (!isRosName(body.name)) {
    throw Error("name", "'" + body.name + "' cannot be part of a topic name",
                "begin with a letter, go on with letters, digits, _ and /");
  }
  if (scene.findBody(body.name)) {
    throw Error("name", "there is a body '" + body.name + "' already", "remove_body it first");
  }
  std::vector<std::size_t> partners;
  for (const std::string& partner : pair_with) {
    if (partner == body.name) {
      throw Error("pair_with", "it names the new body '" + partner + "' itself", "name other bodies");
    }
    const std::size_t index = requireBody(scene, partner);
    if (std::find(partners.begin(), partners.end(), index) == partners.end()) {
      partners.push_back(index);
    }
  }
  if (pair_with.empty()) {
    for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
      if (scene.bodies[index].frame != body.frame) {
        partners.push_back(index);
      }
    }
  }
  scene.bodies.push_back(std::move(body));
  std::vector<std::string> names;
  for (const std::size_t partner : partners) {
    names.push_back(appendPair(scene, scene.bodies.size() - 1, partner, settings));
  }
  return names;
}

std::vector<std::string> removeBody(Scene& scene, const std::string& name) {
  const std::size_t gone = requireBody(scene, name);
  std::vector<std::string> names;
  std::vector<ScenePair> kept;
  for (ScenePair& pair : scene.pairs) {
    if (pair.body_a == gone || pair.body_b == gone) {
      names.push_back(pair.name);
      continue;
    }
    pair.body_a -= pair.body_a > gone ? 1 : 0;
    pair.body_b -= pair.body_b > gone ? 1 : 0;
    kept.push_back(std::move(pair));
  }
  scene.pairs = std::move(kept);
  scene.bodies.erase(scene.bodies.begin() + static_cast<std::ptrdiff_t>(gone));
  return names;
}

std::string setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                           const PairSettings& settings) {
  if (!reference.pair.empty()) {
    scene.pairs[requirePair(scene, reference.pair)].enabled = enabled;
    return reference.pair;
  }
  const std::size_t body_a = requireBody(scene, reference.body_a);
  const std::size_t body_b = requireBody(scene, reference.body_b);
  if (body_a == body_b) {
    throw Error("pair", "both bodies are '" + reference.body_a + "'", "name two different bodies");
  }
  if (const auto found = scene.findPair(reference.body_a, reference.body_b)) {
    scene.pairs[*found].enabled = enabled;
    return scene.pairs[*found].name;
  }
  if (!enabled) {
    throw Error("pair",
                "'" + reference.body_a + "' and '" + reference.body_b + "' are no pair that is watched",
                "nothing to switch off");
  }
  return appendPair(scene, body_a, body_b, settings);
}

}  // namespace concave_distance
