#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// One entry for each body of a scene: whether it is on this side of some pairs.
using BodySide = std::vector<bool>;

/// Tells a change of rules about the pairs of two classes.
struct RuledBodies {
  bool both_are_links = false;           ///< of robots
  PairOrder order = PairOrder::Earlier;  ///< which of the two is on side A
};
using RuleChange = std::function<void(PairRule& rule, PairSettings& settings, const RuledBodies& bodies)>;

/// Changes the rules of the pairs with one body on each side, in either order: classes whose bodies do not
/// all stand on the same sides are split, those without bodies go. Listed pairs stay as they are.
void changeRules(Scene& scene, const BodySide& side_a, const BodySide& side_b, const RuleChange& change);
/// Takes out classes without bodies when most are.
void takeOutEmptyClasses(Scene& scene);
/// Returns the class of an added body whose pairs with earlier bodies have these settings.
std::uint32_t classOfAdded(Scene& scene, const PairSettings& settings);

/// Changes a pair. @param where names it for errors
using PairChange = std::function<void(const std::string& where, bool& enabled, PairSettings& settings)>;

/// Most names of pairs that one answer lists.
inline constexpr std::size_t kMostPairsNamed = 1000;

/// Changes the pairs of a name or pattern (`*` and `?`). A pattern says how the labels of the two bodies
/// begin, in either order for pairs by rule. A pair that is named becomes a listed one.
/// @return their names, kMostPairsNamed at most of pairs by rule
/// @throws Error when no pair matches, and what `change` throws; then nothing is changed if the caller drops
/// the scene
std::vector<std::string> changeMatchingPairs(Scene& scene, const std::string& pattern,
                                             const PairChange& change);

/// Lists the pairs by rule whose names match one of the patterns, as far as the scene's limit of pairs
/// allows.
void listMatchingPairs(Scene& scene, const std::vector<std::string>& patterns);

}  // namespace concave_distance::detail
