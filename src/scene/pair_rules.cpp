#include "concave_distance/scene/pair_rules.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <tuple>
#include <unordered_map>

#include "base/free_name.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {
namespace {

bool isFiltered(const PairRules& rules, std::uint64_t serial_a, std::uint64_t serial_b) {
  return rules.filtered &&
         std::binary_search(rules.filtered->begin(), rules.filtered->end(),
                            std::pair<std::uint64_t, std::uint64_t>(std::minmax(serial_a, serial_b)));
}

bool mayTouch(const SceneBody& a, const SceneBody& b) {
  return (a.attachment && a.attachment->may_touch.count(b.serial) != 0) ||
         (b.attachment && b.attachment->may_touch.count(a.serial) != 0);
}

// Labels of bodies that have another name are rare.
std::optional<std::size_t> findLabel(const Scene& scene, const std::string& label) {
  const std::optional<std::size_t> body = scene.bodies.find(label);
  if (body && scene.bodies[*body].pairLabel() == label) return body;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].label.empty() && scene.bodies[i].label == label) return i;
  }
  return std::nullopt;
}

// Returns for each body those that never move against it, with itself; nullptr where there is no other.
std::vector<std::shared_ptr<const BodySet>> rigidBodiesOf(const Scene& scene) {
  std::unordered_map<std::string, std::vector<std::size_t>> bodies_of_root;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const bool is_carried = body.carrier != 0;
    bodies_of_root[is_carried ? "\n" + std::to_string(body.carrier) : scene.rigid.rootOf(body.frame)]
        .push_back(i);
  }
  std::vector<std::shared_ptr<const BodySet>> rigid(scene.bodies.size());
  for (const auto& [root, bodies] : bodies_of_root) {
    if (bodies.size() < 2) continue;
    const auto set = std::make_shared<const BodySet>(bodies);
    for (const std::size_t body : bodies) rigid[body] = set;
  }
  return rigid;
}

// Returns whether a filter or an attachment leaves the pair out, or the scene lists it: then no rule decides.
bool isException(const Scene& scene, std::size_t earlier, std::size_t later) {
  const SceneBody& a = scene.bodies[earlier];
  const SceneBody& b = scene.bodies[later];
  return isFiltered(scene.rules, a.serial, b.serial) || mayTouch(a, b) || scene.pairs.find(earlier, later);
}

// Returns the pairs of which isException() is true, the later body first, each once.
std::vector<std::pair<std::size_t, std::size_t>> exceptionsOf(const Scene& scene) {
  std::vector<std::pair<std::size_t, std::size_t>> exceptions;
  for (const ScenePair& pair : scene.pairs)
    exceptions.emplace_back(std::max(pair.body_a, pair.body_b), std::min(pair.body_a, pair.body_b));
  std::unordered_map<std::uint64_t, std::size_t> index;  // by serial
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) index.emplace(scene.bodies[i].serial, i);
  const auto add = [&](std::uint64_t serial_a, std::uint64_t serial_b) {
    const auto a = index.find(serial_a);
    const auto b = index.find(serial_b);
    if (a == index.end() || b == index.end()) return;
    exceptions.emplace_back(std::max(a->second, b->second), std::min(a->second, b->second));
  };
  if (scene.rules.filtered) {
    for (const auto& [a, b] : *scene.rules.filtered) add(a, b);
  }
  for (const SceneBody& body : scene.bodies) {
    if (!body.attachment) continue;
    for (const std::uint64_t other : body.attachment->may_touch) add(body.serial, other);
  }
  std::sort(exceptions.begin(), exceptions.end());
  exceptions.erase(std::unique(exceptions.begin(), exceptions.end()), exceptions.end());
  return exceptions;
}

}  // namespace

std::uint64_t newBodySerial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

bool areRigid(const Scene& scene, const SceneBody& a, const SceneBody& b) {
  return a.carrier == b.carrier &&
         (a.carrier != 0 || a.frame == b.frame || scene.rigid.areJoined(a.frame, b.frame));
}

const PairRule& PairRules::of(std::size_t earlier, std::size_t later) const {
  static const PairRule none;
  const auto last = std::find_if(list.rbegin(), list.rend(),
                                 [&](const PairRule& rule) { return rule.holds(earlier, later); });
  return last == list.rend() ? none : *last;
}

// As of() for all pairs of a body with earlier ones at once.
BodySet PairRules::watchedBefore(std::size_t body, bool only_enabled) const {
  BodySet watched;
  for (const PairRule& rule : list) {
    if (!rule.later.contains(body)) continue;
    if (rule.is_watched && (rule.is_enabled || !only_enabled)) {
      watched |= rule.earlier;
    } else {
      watched -= rule.earlier;
    }
  }
  watched.keepBefore(body);
  return watched;
}

// Less those of which each pair has a later rule.
BodySet PairRules::bodiesOf(std::size_t rule) const {
  BodySet earlier = list[rule].earlier;
  BodySet later = list[rule].later;
  for (std::size_t i = rule + 1; i < list.size(); ++i) {
    if (list[rule].later.isWithin(list[i].later)) earlier -= list[i].earlier;
    if (list[rule].earlier.isWithin(list[i].earlier)) later -= list[i].later;
  }
  return earlier | later;
}

BodySet PairRules::allBodies() const {
  BodySet bodies;
  for (const PairRule& rule : list) (bodies |= rule.earlier) |= rule.later;
  return bodies;
}

const PairRule* ruleOf(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const auto [earlier, later] = std::minmax(body_a, body_b);
  if (earlier == later) return nullptr;
  const PairRule& rule = scene.rules.of(earlier, later);
  const bool is_left_out = !rule.is_watched || isException(scene, earlier, later) ||
                           areRigid(scene, scene.bodies[earlier], scene.bodies[later]);
  return is_left_out ? nullptr : &rule;
}

const PairSettings& settingsOf(const Scene& scene, const PairRule& rule) {
  return rule.settings == 0 ? scene.defaults.pairs : scene.rules.settings[rule.settings];
}

std::string freePairName(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  return freeName(scene.bodies[body_a].pairLabel() + "/" + scene.bodies[body_b].pairLabel(),
                  [&](const std::string& name) { return scene.pairs.find(name).has_value(); });
}

std::optional<ScenePair> ruledPair(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const PairRule* rule = ruleOf(scene, body_a, body_b);
  if (rule == nullptr) return std::nullopt;
  ScenePair pair;
  std::tie(pair.body_a, pair.body_b) = rule->ordered(body_a, body_b);
  pair.name = freePairName(scene, pair.body_a, pair.body_b);
  pair.enabled = rule->is_enabled;
  pair.settings = settingsOf(scene, *rule);
  pair.is_from_rule = true;
  return pair;
}

std::optional<ScenePair> pairOf(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  if (const auto listed = scene.pairs.find(body_a, body_b)) return scene.pairs[*listed];
  return ruledPair(scene, body_a, body_b);
}

std::optional<ScenePair> findPairNamed(const Scene& scene, const std::string& name) {
  if (const auto listed = scene.pairs.find(name)) return scene.pairs[*listed];
  // Names of bodies may have slashes, and a name that a listed pair has taken ends in a number.
  const std::size_t number = name.find_last_of('_');
  for (const std::string& whole : {name, number == std::string::npos ? name : name.substr(0, number)}) {
    for (std::size_t at = whole.find('/'); at != std::string::npos; at = whole.find('/', at + 1)) {
      const auto a = findLabel(scene, whole.substr(0, at));
      const auto b = a ? findLabel(scene, whole.substr(at + 1)) : std::nullopt;
      if (!b) continue;
      std::optional<ScenePair> pair = ruledPair(scene, *a, *b);
      if (pair && pair->name == name) return pair;
    }
  }
  return std::nullopt;
}

// Bodies that came with the scene each with the later ones, then each added body with the earlier ones.
PairList allPairs(const Scene& scene, std::size_t most) {
  PairList pairs;
  for (std::size_t i = 0; i < scene.pairs.size() && pairs.size() < most; ++i) {
    pairs.appendShared(scene.pairs, i);
  }
  const auto add = [&](std::size_t earlier, std::size_t later) {
    if (pairs.size() >= most) return;
    if (std::optional<ScenePair> pair = ruledPair(scene, earlier, later)) pairs.push_back(std::move(*pair));
  };
  const std::size_t count = scene.bodies.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count && pairs.size() < most; ++j) {
      if (!scene.bodies[j].is_added) add(i, j);
    }
  }
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < j && scene.bodies[j].is_added; ++i) add(i, j);
  }
  return pairs;
}

std::size_t countPairsByRule(const Scene& scene) {
  const BodySet all = BodySet::before(scene.bodies.size());
  return countPairsByRule(scene, {{all, all}});
}

std::size_t countPairsByRule(const Scene& scene, const std::vector<std::pair<BodySet, BodySet>>& sides) {
  const auto rigid_bodies = rigidBodiesOf(scene);
  const auto exceptions = exceptionsOf(scene);
  std::size_t count = 0;
  for (const auto& [earlier, later] : sides) {
    for (const std::size_t body : later.indices()) {
      BodySet others = scene.rules.watchedBefore(body, true);
      others &= earlier;
      if (rigid_bodies[body]) others -= *rigid_bodies[body];
      count += others.size();
      auto exception =
          std::lower_bound(exceptions.begin(), exceptions.end(), std::pair(body, std::size_t{0}));
      for (; exception != exceptions.end() && exception->first == body; ++exception)
        count -= others.contains(exception->second) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace concave_distance
