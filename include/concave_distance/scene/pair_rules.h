#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/body_set.h"

namespace concave_distance {

struct PairSettings;
struct Scene;
struct SceneBody;

/// Says which of two bodies is body A of their pair.
enum class PairOrder : std::uint8_t {
  Earlier,  ///< the one that stands earlier in Scene::bodies
  Later
};

/// Says how pairs are watched whose two bodies are in the two sets.
struct PairRule {
  BodySet earlier;  ///< holds the body that stands earlier in Scene::bodies ...
  BodySet later;    ///< ... and this one the other
  bool is_watched = false;
  bool is_enabled = true;
  PairOrder order = PairOrder::Earlier;
  /// Index in PairRules::settings; 0 stands for Scene::defaults, and the entry at 0 is not read.
  std::uint32_t settings = 0;

  bool holds(std::size_t earlier_body, std::size_t later_body) const {
    return earlier.contains(earlier_body) && later.contains(later_body);
  }
  /// Watches its pairs; body A stays where it was watched already.
  void watch(PairOrder wanted) {
    if (!is_watched) order = wanted;
    is_watched = true;
  }
  /// Returns body A and body B of a pair.
  std::pair<std::size_t, std::size_t> ordered(std::size_t body, std::size_t other) const {
    const std::pair<std::size_t, std::size_t> bodies = std::minmax(body, other);
    return order == PairOrder::Earlier ? bodies : std::pair(bodies.second, bodies.first);
  }
};

/// Says which two bodies of a scene are watched, and with which settings, without a list of pairs. A pair
/// that Scene::pairs lists follows no rule.
struct PairRules {
  std::vector<PairRule> list;
  std::vector<PairSettings> settings;  ///< by PairRule::settings; see there for the first
  /// Pairs of SceneBody::serial, the lesser first, ascending: what adjacency and SRDFs leave out.
  std::shared_ptr<const std::vector<std::pair<std::uint64_t, std::uint64_t>>> filtered;

  /// Returns the rule that decides the pair of two bodies: the last one in the list that holds it, else one
  /// that watches nothing.
  const PairRule& of(std::size_t earlier, std::size_t later) const;
  /// Returns the bodies before this one whose pairs with it are watched, and enabled if that is asked for.
  BodySet watchedBefore(std::size_t body, bool only_enabled) const;
  /// Returns the bodies of the pairs that a rule of the list decides.
  BodySet bodiesOf(std::size_t rule) const;
  /// Returns the bodies that any rule of the list names.
  BodySet allBodies() const;
};

/// Returns whether nothing moves the two bodies against each other: their frames are one or rigidly
/// connected, and no edit moves one alone.
bool areRigid(const Scene& scene, const SceneBody& a, const SceneBody& b);

/// Returns the rule of two bodies, places in scene.bodies, when it watches them: neither a filter, areRigid()
/// nor an attachment leaves them out, and scene.pairs does not list them. Else nullptr. Some 0.3 us.
const PairRule* ruleOf(const Scene& scene, std::size_t body_a, std::size_t body_b);
/// Returns the settings that a rule gives.
const PairSettings& settingsOf(const Scene& scene, const PairRule& rule);

/// Counts the enabled pairs that the rules give. Of 1000 bodies it takes some 0.2 ms.
std::size_t countPairsByRule(const Scene& scene);
/// Counts those with the earlier body on the first and the later one on the second of two sides that hold
/// no pair twice.
std::size_t countPairsByRule(const Scene& scene, const std::vector<std::pair<BodySet, BodySet>>& sides);

}  // namespace concave_distance
