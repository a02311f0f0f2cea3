#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Changes a rule and its settings. The order says which side of the edit the earlier body is on: the first
/// or, with PairOrder::Later, the second. Of bodies on both sides it is called once more, with Later.
using RuleChange = std::function<void(PairRule& rule, PairSettings& settings, PairOrder order)>;

/// Changes what the rules say of the pairs with one body on each side, in either order. Listed pairs stay as
/// they are.
void changeRules(Scene& scene, const BodySet& side_a, const BodySet& side_b, const RuleChange& change);
/// Does so for pairs whose earlier body is on the first side alone.
void changeOrderedRules(Scene& scene, const BodySet& earlier, const BodySet& later, PairOrder order,
                        const RuleChange& change);
/// Says how the last body of the scene, a new one, is watched against the earlier ones: those of `partners`
/// with these settings. It is body A.
void addRulesOfNewBody(Scene& scene, const BodySet& partners, const PairSettings& settings);
/// Follows bodies that leave the scene.
void takeOutOfRules(PairRules& rules, const std::vector<bool>& gone);

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
