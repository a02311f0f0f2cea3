#include "concave_distance/scene/pair_rules.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

#include "concave_distance/scene/scene.h"

namespace concave_distance {
namespace {

bool isFiltered(const PairRules& rules, std::uint64_t serial_a, std::uint64_t serial_b) {
  return rules.filtered &&
         std::binary_search(rules.filtered->begin(), rules.filtered->end(),
                            std::pair<std::uint64_t, std::uint64_t>(std::minmax(serial_a, serial_b)));
}

// Without filters.
bool isWatched(const Scene& scene, std::size_t earlier, std::size_t later) {
  const SceneBody& a = scene.bodies[earlier];
  const SceneBody& b = scene.bodies[later];
  return scene.rules.of(a.pair_class, b.pair_class).is_watched ||
         (b.added_rule && b.added_rule->watches(a.serial));
}

bool mayTouch(const SceneBody& a, const SceneBody& b) {
  return (a.attachment && a.attachment->may_touch.count(b.serial) != 0) ||
         (b.attachment && b.attachment->may_touch.count(a.serial) != 0);
}

std::string nameOf(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const std::string wanted = scene.bodies[body_a].pairLabel() + "/" + scene.bodies[body_b].pairLabel();
  std::string name = wanted;
  for (int copy = 2; scene.pairs.find(name); ++copy) name = wanted + "_" + std::to_string(copy);
  return name;
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

/// Counts bodies of each class, in all and in each set of frames that never move against each other.
class EarlierBodies {
 public:
  EarlierBodies(const Scene& scene) : in_all_(scene.rules.classes, 0) {}
  void add(std::uint32_t pair_class, std::size_t rigid_set) {
    ++in_all_[pair_class];
    ++in_set_[{rigid_set, pair_class}];
  }
  std::size_t thatMoveAgainst(std::size_t pair_class, std::size_t rigid_set) const {
    const auto found = in_set_.find({rigid_set, pair_class});
    return in_all_[pair_class] - (found == in_set_.end() ? 0 : found->second);
  }

 private:
  std::vector<std::size_t> in_all_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> in_set_;
};

}  // namespace

std::uint64_t newBodySerial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

bool areRigid(const Scene& scene, const SceneBody& a, const SceneBody& b) {
  return a.carrier == b.carrier &&
         (a.carrier != 0 || a.frame == b.frame || scene.rigid.areJoined(a.frame, b.frame));
}

const PairRule* ruleOf(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const auto [earlier, later] = std::minmax(body_a, body_b);
  if (earlier == later || !isWatched(scene, earlier, later)) return nullptr;
  const SceneBody& a = scene.bodies[earlier];
  const SceneBody& b = scene.bodies[later];
  if (isFiltered(scene.rules, a.serial, b.serial) || mayTouch(a, b) || scene.pairs.find(earlier, later) ||
      areRigid(scene, a, b)) {
    return nullptr;
  }
  return &scene.rules.of(a.pair_class, b.pair_class);
}

const PairSettings& settingsOf(const Scene& scene, const PairRule& rule) {
  return rule.settings == 0 ? scene.defaults.pairs : scene.rules.settings[rule.settings];
}

std::optional<ScenePair> ruledPair(const Scene& scene, std::size_t body_a, std::size_t body_b) {
  const PairRule* rule = ruleOf(scene, body_a, body_b);
  if (rule == nullptr) return std::nullopt;
  ScenePair pair;
  std::tie(pair.body_a, pair.body_b) = std::minmax(body_a, body_b);
  const std::shared_ptr<const AddedBodyRule>& added = scene.bodies[pair.body_b].added_rule;
  const bool is_turned =
      added && added->watches(scene.bodies[pair.body_a].serial) ? true : rule->order == PairOrder::Later;
  if (is_turned) std::swap(pair.body_a, pair.body_b);
  pair.name = nameOf(scene, pair.body_a, pair.body_b);
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
      if (!scene.bodies[j].added_rule) add(i, j);
    }
  }
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < j && scene.bodies[j].added_rule; ++i) add(i, j);
  }
  return pairs;
}

std::size_t countRuledPairs(const Scene& scene, const std::vector<bool>& left_out) {
  const PairRules& rules = scene.rules;
  const auto counts = [&](std::size_t body) { return left_out.empty() || !left_out[body]; };
  std::unordered_map<std::string, std::size_t> set_of_root;
  std::vector<std::size_t> rigid_set;
  std::unordered_map<std::uint64_t, std::size_t> place;  // by serial
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const std::string root =
        body.carrier == 0 ? scene.rigid.rootOf(body.frame) : "\n" + std::to_string(body.carrier);
    rigid_set.push_back(set_of_root.emplace(root, set_of_root.size()).first->second);
    place.emplace(scene.bodies[i].serial, i);
  }
  const auto is_counted = [&](std::size_t i, std::size_t j) {  // by the classes alone
    return i != j && counts(i) && counts(j) && rigid_set[i] != rigid_set[j] &&
           isWatched(scene, std::min(i, j), std::max(i, j)) &&
           rules.of(scene.bodies[std::min(i, j)].pair_class, scene.bodies[std::max(i, j)].pair_class)
               .is_enabled;
  };
  std::size_t count = 0;
  std::size_t too_many = 0;
  EarlierBodies earlier(scene);
  for (std::size_t j = 0; j < scene.bodies.size(); ++j) {
    if (!counts(j)) continue;
    const SceneBody& body = scene.bodies[j];
    const bool all = body.added_rule && body.added_rule->all;
    for (std::size_t row = 0; row < rules.classes; ++row) {
      const PairRule& rule = rules.of(row, body.pair_class);
      if (rule.is_enabled && (rule.is_watched || all)) count += earlier.thatMoveAgainst(row, rigid_set[j]);
    }
    if (body.added_rule) {
      for (const std::uint64_t serial : body.added_rule->bodies) {
        const auto other = place.find(serial);
        if (other == place.end() || other->second >= j || !counts(other->second)) continue;
        const PairRule& rule = rules.of(scene.bodies[other->second].pair_class, body.pair_class);
        if (rule.is_watched || !rule.is_enabled || rigid_set[other->second] == rigid_set[j]) continue;
        ++(all ? too_many : count);
      }
    }
    earlier.add(body.pair_class, rigid_set[j]);
  }
  if (rules.filtered) {
    for (const auto& [serial_a, serial_b] : *rules.filtered) {
      const auto a = place.find(serial_a);
      const auto b = place.find(serial_b);
      if (a == place.end() || b == place.end()) continue;
      if (is_counted(a->second, b->second) && !scene.pairs.find(a->second, b->second)) ++too_many;
    }
  }
  for (const ScenePair& pair : scene.pairs) too_many += is_counted(pair.body_a, pair.body_b) ? 1 : 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (!body.attachment) continue;
    for (const std::uint64_t serial : body.attachment->may_touch) {
      const auto at = place.find(serial);
      if (at == place.end() || !is_counted(i, at->second) || scene.pairs.find(i, at->second)) continue;
      const SceneBody& other = scene.bodies[at->second];
      const bool is_met_twice =
          other.attachment && other.attachment->may_touch.count(body.serial) != 0 && at->second < i;
      if (!is_met_twice && !isFiltered(rules, body.serial, serial)) ++too_many;
    }
  }
  return count - too_many;
}

}  // namespace concave_distance
