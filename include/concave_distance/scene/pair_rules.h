#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

namespace concave_distance {

struct PairSettings;
struct Scene;
struct SceneBody;
class PairList;

/// Says which of two bodies is body A of their pair.
enum class PairOrder : std::uint8_t {
  Earlier,  ///< the one that stands earlier in Scene::bodies
  Later
};

/// Holds what the rules of a scene say of the pairs of two classes of bodies.
struct PairRule {
  bool is_watched = false;  ///< unless a filter leaves the pair out
  bool is_enabled = true;
  PairOrder order = PairOrder::Earlier;
  /// Place in PairRules::settings; 0 stands for Scene::defaults, and the entry at 0 is not read.
  std::uint32_t settings = 0;
};

/// Says which two bodies of a scene are watched, and with which settings, without a list of pairs: bodies
/// that all entries of the scene file name alike are one class (SceneBody::pair_class), and each two classes
/// have one rule. A pair that Scene::pairs lists follows no rule.
struct PairRules {
  std::size_t classes = 1;
  /// Row by row: the class of the earlier body, then that of the later one, as Scene::bodies has them.
  std::vector<PairRule> table = std::vector<PairRule>(1);
  std::vector<PairSettings> settings;  ///< by PairRule::settings; see there for the first
  /// Pairs of SceneBody::serial, the lesser first, ascending: what adjacency and SRDFs leave out.
  std::shared_ptr<const std::vector<std::pair<std::uint64_t, std::uint64_t>>> filtered;

  const PairRule& of(std::size_t earlier, std::size_t later) const {
    return table[earlier * classes + later];
  }
  PairRule& of(std::size_t earlier, std::size_t later) { return table[earlier * classes + later]; }
};

/// Says which earlier bodies a body that was added while the scene ran is watched against, besides what the
/// table of classes says. The later of two such bodies decides. Body A of these pairs is the added one.
struct AddedBodyRule {
  bool all = false;                          ///< every body but `bodies`; false: `bodies` alone
  std::unordered_set<std::uint64_t> bodies;  ///< SceneBody::serial

  bool watches(std::uint64_t serial) const { return (bodies.count(serial) != 0) != all; }
};

/// Returns whether nothing moves the two bodies against each other: their frames are one or rigidly
/// connected, and no edit moves one alone.
bool areRigid(const Scene& scene, const SceneBody& a, const SceneBody& b);

/// Returns the rule of two bodies, places in scene.bodies, when it watches them: neither a filter, areRigid()
/// nor an attachment leaves them out, and scene.pairs does not list them. Else nullptr. Some 0.3 us.
const PairRule* ruleOf(const Scene& scene, std::size_t body_a, std::size_t body_b);
/// Returns the settings that a rule gives.
const PairSettings& settingsOf(const Scene& scene, const PairRule& rule);

/// Returns the number of enabled pairs that the rules give. O(bodies x classes).
/// @param left_out bodies whose pairs do not count, one entry each; empty: none
std::size_t countRuledPairs(const Scene& scene, const std::vector<bool>& left_out = {});

}  // namespace concave_distance
