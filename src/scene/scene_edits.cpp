#include "scene_edits.h"

#include <algorithm>
#include <utility>

#include "base/ascii.h"
#include "base/free_name.h"
#include "concave_distance/base/error.h"
#include "matching_bodies.h"
#include "rule_edits.h"

namespace concave_distance {
namespace {

bool isLabel(const Scene& scene, const std::string& label) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const SceneBody& body) { return body.pairLabel() == label; });
}

void appendPair(Scene& scene, std::size_t body_a, std::size_t body_b, const PairSettings& settings) {
  ScenePair pair;
  pair.name = freePairName(scene, body_a, body_b);
  pair.body_a = body_a;
  pair.body_b = body_b;
  pair.settings = settings;
  scene.pairs.push_back(std::move(pair));
}

void requireRoomForPairs(const Scene& scene, std::size_t more) {
  const std::size_t pairs = scene.pairs.size();
  if (more > scene.limits.pairs || pairs > scene.limits.pairs - more) {
    throw Error("pairs",
                std::to_string(more) + " new named pairs besides the " + std::to_string(pairs) +
                    " of the scene, the limit is " + std::to_string(scene.limits.pairs),
                "name fewer bodies, use groups and patterns, or raise ~limits/largest_pair_count");
  }
}

// Returns whether enabling a group may create the pair of two bodies that no rule watches.
bool mayBeCreated(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const SceneBody& a = scene.bodies[body_a];
  const SceneBody& b = scene.bodies[body_b];
  return !areRigid(scene, a, b) && !(a.is_robot_link && b.is_robot_link);
}

BodySet withoutLinks(const Scene& scene, const std::vector<std::size_t>& bodies) {
  BodySet others;
  for (const std::size_t body : bodies) {
    if (!scene.bodies[body].is_robot_link) others.insert(body);
  }
  return others;
}

std::vector<std::string> setOnePairEnabled(Scene& scene, std::size_t body_a, std::size_t body_b, bool enabled,
                                           const PairSettings& settings) {
  std::optional<std::size_t> place = scene.pairs.find(body_a, body_b);
  if (!place) {
    std::optional<ScenePair> pair = ruledPair(scene, body_a, body_b);
    if (!pair && !enabled) return {};
    requireRoomForPairs(scene, 1);
    if (pair) {
      scene.pairs.push_back(std::move(*pair));
    } else {
      appendPair(scene, body_a, body_b, settings);
    }
    place = scene.pairs.size() - 1;
  }
  ScenePair& pair = scene.pairs.edit(*place);
  pair.enabled = enabled;
  pair.is_from_rule = false;
  return {pair.name};
}

// Of all pairs of the two sides: first those that are there, then those that are created.
std::vector<std::string> setGroupsEnabled(Scene& scene, const std::vector<std::size_t>& bodies_a,
                                          const std::vector<std::size_t>& bodies_b, bool enabled) {
  const BodySet side_a(bodies_a);
  const BodySet side_b(bodies_b);
  std::vector<std::string> names;
  std::vector<std::pair<std::size_t, std::size_t>> missing;
  for (const std::size_t a : bodies_a) {
    for (const std::size_t b : bodies_b) {
      const bool is_met_twice = side_a.contains(b) && side_b.contains(a) && b < a;
      if (a == b || is_met_twice || names.size() + missing.size() >= detail::kMostPairsNamed) continue;
      if (const std::optional<ScenePair> pair = pairOf(scene, a, b)) {
        names.push_back(pair->name);
      } else if (enabled && mayBeCreated(scene, a, b)) {
        missing.emplace_back(a, b);
      }
    }
  }
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const ScenePair& pair = scene.pairs[i];
    if ((side_a.contains(pair.body_a) && side_b.contains(pair.body_b)) ||
        (side_a.contains(pair.body_b) && side_b.contains(pair.body_a))) {
      scene.pairs.edit(i).enabled = enabled;
    }
  }
  detail::changeRules(scene, side_a, side_b,
                      [&](PairRule& rule, PairSettings&, PairOrder) { rule.is_enabled = enabled; });
  // Links of robots are watched against each other only when a person names both.
  const auto watch = [&](const BodySet& a, const BodySet& b) {
    detail::changeRules(scene, a, b,
                        [](PairRule& rule, PairSettings&, PairOrder order) { rule.watch(order); });
  };
  if (enabled) {
    watch(withoutLinks(scene, bodies_a), side_b);
    watch(side_a, withoutLinks(scene, bodies_b));
  }
  for (const auto& [a, b] : missing) {
    if (const auto pair = ruledPair(scene, a, b)) names.push_back(pair->name);
  }
  return names;
}

void requireNothingAttached(const Scene& scene, const SceneBody& gone) {
  for (const SceneBody& body : scene.bodies) {
    if (body.attachment && body.attachment->parent_serial == gone.serial) {
      throw Error("name", "'" + body.name + "' is attached to '" + gone.name + "'",
                  "detach or remove it first");
    }
  }
}

}  // namespace

std::vector<std::string> pairNamesOf(const Scene& scene, std::size_t body) {
  std::vector<std::string> names;
  for (const ScenePair& pair : scene.pairs) {
    if (pair.body_a == body || pair.body_b == body) names.push_back(pair.name);
  }
  for (std::size_t i = 0; i < scene.bodies.size() && names.size() < detail::kMostPairsNamed; ++i) {
    if (const auto pair = ruledPair(scene, i, body)) names.push_back(pair->name);
  }
  return names;
}

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

void requirePair(const Scene& scene, const std::string& name) {
  if (!findPairNamed(scene, name)) {
    throw Error("pair", "there is no pair '" + name + "'", "list_bodies has their names");
  }
}

void requireRoomForBody(const Scene& scene) {
  if (scene.bodies.size() >= scene.limits.bodies) {
    throw Error("scene", "it has " + std::to_string(scene.bodies.size()) + " bodies, the limit",
                "remove bodies with remove_body, or raise ~limits/largest_body_count");
  }
}

AddedPairs addBody(Scene& scene, SceneBody body, const PairPartners& partners, const PairSettings& settings) {
  AddedPairs added = appendBody(scene, std::move(body), partners, settings);
  added.names = pairNamesOf(scene, scene.bodies.size() - 1);
  return added;
}

AddedPairs appendBody(Scene& scene, SceneBody body, const PairPartners& partners,
                      const PairSettings& settings) {
  requireRoomForBody(scene);
  if (!isRosName(body.name)) {
    throw Error("name", "'" + body.name + "' cannot be part of a topic name",
                "begin with a letter, then letters, digits, _ and /, at most 200 characters");
  }
  if (scene.findBody(body.name)) {
    throw Error("name", "there is a body '" + body.name + "' already", "remove_body it first");
  }
  if (scene.groups.count(body.name) != 0) {
    throw Error("name", "there is a group '" + body.name + "'", "give the body another name");
  }
  AddedPairs added;
  const Partners found = partnersOf(scene, body, partners, added);
  requireRoomForPairs(scene, found.named.size());
  body.serial = newBodySerial();
  body.is_added = true;
  for (const std::string& frame : found.rigid_frames) {
    scene.rigid.join(frame, body.frame);
  }
  added.rigid_frames = found.rigid_frames;
  const std::string label =
      freeName(body.pairLabel(), [&](const std::string& wanted) { return isLabel(scene, wanted); });
  if (label != body.pairLabel()) body.label = label;
  scene.bodies.push_back(std::move(body));
  detail::addRulesOfNewBody(scene, found.by_rule, settings);
  for (const std::size_t partner : found.named) {
    appendPair(scene, scene.bodies.size() - 1, partner, settings);
  }
  return added;
}

std::vector<std::string> removeBody(Scene& scene, const std::string& name, bool allow_robot_link) {
  std::vector<std::string> names = pairNamesOf(scene, requireBody(scene, name));
  takeOutBody(scene, name, allow_robot_link);
  return names;
}

void takeOutBody(Scene& scene, const std::string& name, bool allow_robot_link) {
  const std::size_t gone = requireBody(scene, name);
  if (scene.bodies[gone].is_robot_link && !allow_robot_link) {
    throw Error("name", "'" + name + "' is a link of a robot",
                "set allow_robot_link to remove it anyway, or switch its pairs off with set_pair_enabled");
  }
  requireNothingAttached(scene, scene.bodies[gone]);
  std::vector<bool> is_gone(scene.bodies.size(), false);
  is_gone[gone] = true;
  takeOutBodies(scene, is_gone);
}

void takeOutBodies(Scene& scene, const std::vector<bool>& gone) {
  NamedList<SceneBody> bodies;
  std::vector<std::size_t> index_now;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    index_now.push_back(bodies.size());
    if (!gone[i]) bodies.appendShared(scene.bodies, i);
  }
  PairList kept;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const ScenePair& pair = scene.pairs[i];
    if (gone[pair.body_a] || gone[pair.body_b]) continue;
    const std::size_t a = index_now[pair.body_a];
    const std::size_t b = index_now[pair.body_b];
    if (a == pair.body_a && b == pair.body_b) {
      kept.appendShared(scene.pairs, i);
    } else {
      ScenePair moved = pair;
      moved.body_a = a;
      moved.body_b = b;
      kept.push_back(std::move(moved));
    }
  }
  scene.pairs = std::move(kept);
  scene.bodies = std::move(bodies);
  detail::takeOutOfRules(scene.rules, gone);
}

std::vector<std::string> setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                                        const PairSettings& settings) {
  std::vector<std::string> names;
  if (!reference.pair.empty()) {
    return detail::changeMatchingPairs(
        scene, reference.pair,
        [&](const std::string&, bool& is_enabled, PairSettings&) { is_enabled = enabled; });
  }
  const detail::MatchingBodies a = detail::matchingBodies(scene, reference.body_a, "body_a");
  const detail::MatchingBodies b = detail::matchingBodies(scene, reference.body_b, "body_b");
  if (!(a.is_one_by_name && b.is_one_by_name)) {
    names = setGroupsEnabled(scene, a.bodies, b.bodies, enabled);
  } else if (a.bodies == b.bodies) {
    throw Error("pair", "both bodies are '" + reference.body_a + "'", "name two different bodies");
  } else {
    names = setOnePairEnabled(scene, a.bodies.front(), b.bodies.front(), enabled, settings);
  }
  if (names.empty()) {
    throw Error("pair", "'" + reference.body_a + "' and '" + reference.body_b + "' are not a watched pair",
                enabled ? "name two bodies: groups and patterns do not watch links against links of a robot"
                        : "nothing to switch off");
  }
  return names;
}

}  // namespace concave_distance
