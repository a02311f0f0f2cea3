#include "scene_edits.h"

#include <cctype>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

std::string freePairName(const Scene& scene, const std::string& wanted) {
  std::string name = wanted;
  for (int copy = 2; scene.pairs.find(name); ++copy) {
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

void requireRoomForPairs(const Scene& scene, std::size_t more) {
  const std::size_t pairs = scene.pairs.size();
  if (more > scene.limits.pairs || pairs > scene.limits.pairs - more) {
    throw Error("pairs",
                std::to_string(more) + " new pairs besides the " + std::to_string(pairs) +
                    " of the scene, the limit is " + std::to_string(scene.limits.pairs),
                "name fewer bodies in pair_with, set without_pairs, or raise ~limits/largest_pair_count");
  }
}

// Each body once, in the order of the request.
std::vector<std::size_t> partnersNamed(const Scene& scene, const SceneBody& body,
                                       const std::vector<std::string>& names) {
  std::vector<std::size_t> indices;
  std::unordered_set<std::size_t> seen;
  for (const std::string& name : names) {
    if (name == body.name) {
      throw Error("pair_with", "it names the new body '" + name + "' itself", "name other bodies");
    }
    const std::size_t index = requireBody(scene, name);
    if (seen.insert(index).second) {
      indices.push_back(index);
    }
  }
  return indices;
}

// In the order of the scene.
std::vector<std::size_t> partnersThatMove(const Scene& scene, const SceneBody& body,
                                          const PairPartners& partners, AddedPairs& added) {
  std::unordered_set<std::size_t> touched;
  for (const std::string& name : partners.may_touch) {
    if (const auto index = scene.findBody(name)) {
      touched.insert(*index);
    } else {
      added.unknown.push_back(name);
    }
  }
  // tf is asked once for each frame, because many bodies share few frames.
  std::unordered_map<std::string, bool> rigid;
  const auto is_rigid = [&](const std::string& frame) {
    const auto [place, is_new] = rigid.emplace(frame, false);
    if (is_new) {
      place->second = scene.rigid.areJoined(frame, body.frame) ||
                      (partners.is_rigid && partners.is_rigid(frame, body.frame));
    }
    return place->second;
  };
  std::vector<std::size_t> indices;
  for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
    const SceneBody& other = scene.bodies[index];
    if (other.frame == body.frame || touched.count(index) != 0) {
      continue;
    }
    if (is_rigid(other.frame)) {
      added.rigid_neighbours.push_back(other.name);
    } else {
      indices.push_back(index);
    }
  }
  return indices;
}

std::vector<std::size_t> partnersOf(const Scene& scene, const SceneBody& body, const PairPartners& partners,
                                    AddedPairs& added) {
  if (partners.none && !partners.names.empty()) {
    throw Error("pair_with", "it names '" + partners.names.front() + "', and without_pairs is set",
                "give one of the two");
  }
  if (!partners.names.empty() && !partners.may_touch.empty()) {
    throw Error("touch_links", "pair_with names the bodies to watch already", "leave one of the two empty");
  }
  if (partners.none) {
    return {};
  }
  return partners.names.empty() ? partnersThatMove(scene, body, partners, added)
                                : partnersNamed(scene, body, partners.names);
}

}  // namespace

bool isRosName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  if (name.size() > kLongest) {
    return false;
  }
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
    throw Error("body", "there is no body '" + name + "'", "list_bodies has their names");
  }
  return *found;
}

std::size_t requirePair(const Scene& scene, const std::string& name) {
  if (const auto found = scene.pairs.find(name)) {
    return *found;
  }
  throw Error("pair", "there is no pair '" + name + "'", "list_bodies has their names");
}

void requireRoomForBody(const Scene& scene) {
  if (scene.bodies.size() >= scene.limits.bodies) {
    throw Error("scene", "it has " + std::to_string(scene.bodies.size()) + " bodies, the limit",
                "remove bodies with remove_body, or raise ~limits/largest_body_count");
  }
}

AddedPairs addBody(Scene& scene, SceneBody body, const PairPartners& partners, const PairSettings& settings) {
  requireRoomForBody(scene);
  if (!isRosName(body.name)) {
    throw Error("name", "'" + body.name + "' cannot be part of a topic name",
                "begin with a letter, then letters, digits, _ and /, at most 200 characters");
  }
  if (scene.findBody(body.name)) {
    throw Error("name", "there is a body '" + body.name + "' already", "remove_body it first");
  }
  AddedPairs added;
  const std::vector<std::size_t> indices = partnersOf(scene, body, partners, added);
  requireRoomForPairs(scene, indices.size());
  scene.bodies.push_back(std::move(body));
  for (const std::size_t partner : indices) {
    added.names.push_back(appendPair(scene, scene.bodies.size() - 1, partner, settings));
  }
  return added;
}

std::vector<std::string> removeBody(Scene& scene, const std::string& name, bool allow_robot_link) {
  const std::size_t gone = requireBody(scene, name);
  if (scene.bodies[gone].is_robot_link && !allow_robot_link) {
    throw Error("name", "'" + name + "' is a link of a robot",
                "set allow_robot_link to remove it anyway, or switch its pairs off with set_pair_enabled");
  }
  std::vector<std::string> names;
  PairList kept;
  for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
    const ScenePair& pair = scene.pairs[index];
    if (pair.body_a == gone || pair.body_b == gone) {
      names.push_back(pair.name);
    } else if (pair.body_a < gone && pair.body_b < gone) {
      kept.appendShared(scene.pairs, index);
    } else {
      ScenePair moved = pair;
      moved.body_a -= pair.body_a > gone ? 1 : 0;
      moved.body_b -= pair.body_b > gone ? 1 : 0;
      kept.push_back(std::move(moved));
    }
  }
  NamedList<SceneBody> bodies;
  for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
    if (index != gone) {
      bodies.appendShared(scene.bodies, index);
    }
  }
  scene.pairs = std::move(kept);
  scene.bodies = std::move(bodies);
  return names;
}

std::string setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                           const PairSettings& settings) {
  if (!reference.pair.empty()) {
    scene.pairs.edit(requirePair(scene, reference.pair)).enabled = enabled;
    return reference.pair;
  }
  const std::size_t body_a = requireBody(scene, reference.body_a);
  const std::size_t body_b = requireBody(scene, reference.body_b);
  if (body_a == body_b) {
    throw Error("pair", "both bodies are '" + reference.body_a + "'", "name two different bodies");
  }
  if (const auto found = scene.findPair(reference.body_a, reference.body_b)) {
    scene.pairs.edit(*found).enabled = enabled;
    return scene.pairs[*found].name;
  }
  if (!enabled) {
    throw Error("pair", "'" + reference.body_a + "' and '" + reference.body_b + "' are not a watched pair",
                "nothing to switch off");
  }
  requireRoomForPairs(scene, 1);
  return appendPair(scene, body_a, body_b, settings);
}

}  // namespace concave_distance
