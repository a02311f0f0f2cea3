#include "scene_edits.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/ascii.h"
#include "concave_distance/base/error.h"
#include "matching_bodies.h"
#include "matching_pairs.h"

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

// Returns whether a filter can have left out the pair of two bodies that a scene has not.
bool mayBeFiltered(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const SceneBody& a = scene.bodies[body_a];
  const SceneBody& b = scene.bodies[body_b];
  return a.frame == b.frame || scene.rigid.areJoined(a.frame, b.frame) ||
         (a.is_robot_link && b.is_robot_link);
}

// Every pair of the two sides, once: the places of those in the scene, and the bodies of those to create.
struct SidesPairs {
  std::vector<std::size_t> there;
  std::vector<std::pair<std::size_t, std::size_t>> missing;
};

SidesPairs pairsOfSides(const Scene& scene, const PairReference& reference) {
  const detail::MatchingBodies a = detail::matchingBodies(scene, reference.body_a, "body_a");
  const detail::MatchingBodies b = detail::matchingBodies(scene, reference.body_b, "body_b");
  const bool is_one_pair = a.is_one_by_name && b.is_one_by_name;
  if (is_one_pair && a.bodies == b.bodies) {
    throw Error("pair", "both bodies are '" + reference.body_a + "'", "name two different bodies");
  }
  SidesPairs pairs;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (const std::size_t body_a : a.bodies) {
    for (const std::size_t body_b : b.bodies) {
      if (body_a == body_b || !seen.insert(std::minmax(body_a, body_b)).second) {
        continue;
      }
      if (const auto found = scene.pairs.find(body_a, body_b)) {
        pairs.there.push_back(*found);
      } else if (is_one_pair || !mayBeFiltered(scene, body_a, body_b)) {
        pairs.missing.emplace_back(body_a, body_b);
      }
    }
  }
  return pairs;
}

}  // namespace

bool isRosName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  if (name.size() > kLongest) {
    return false;
  }
  bool part_begins = true;
  for (const char c : name) {
    if (c == '/' ? part_begins : !isLetterOrDigit(c) && c != '_') {
      return false;
    }
    part_begins = c == '/';
  }
  return !part_begins && isLetter(name.front());
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

std::vector<std::string> setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                                        const PairSettings& settings) {
  SidesPairs pairs;
  if (reference.pair.empty()) {
    pairs = pairsOfSides(scene, reference);
  } else {
    pairs.there = detail::matchingPairs(scene, reference.pair);
  }
  if (pairs.there.empty() && (pairs.missing.empty() || !enabled)) {
    throw Error("pair", "'" + reference.body_a + "' and '" + reference.body_b + "' are not a watched pair",
                enabled ? "name two bodies: groups and patterns do not watch links against links of a robot"
                        : "nothing to switch off");
  }
  std::vector<std::string> names;
  for (const std::size_t index : pairs.there) {
    scene.pairs.edit(index).enabled = enabled;
    names.push_back(scene.pairs[index].name);
  }
  if (enabled) {
    requireRoomForPairs(scene, pairs.missing.size());
    for (const auto& [body_a, body_b] : pairs.missing) {
      names.push_back(appendPair(scene, body_a, body_b, settings));
    }
  }
  return names;
}

}  // namespace concave_distance
