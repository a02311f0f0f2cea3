#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "pair_partners.h"

namespace concave_distance {

/// True for at most 200 letters, digits, _ and /, beginning with a letter and without empty parts: usable in
/// topic names.
bool isRosName(const std::string& name);

/// @throws Error when the scene has its largest number of bodies
void requireRoomForBody(const Scene& scene);

/// Adds a body and its pairs with its partners: those that are named by themselves are listed, the rule of
/// the body gives the others.
/// @throws Error when a body or a group has the name or it is not a ROS name, when a partner is unknown or
/// the
///         body itself, or when the scene would exceed its limits
AddedPairs addBody(Scene& scene, SceneBody body, const PairPartners& partners, const PairSettings& settings);
/// Appends it without the names of its pairs.
AddedPairs appendBody(Scene& scene, SceneBody body, const PairPartners& partners,
                      const PairSettings& settings);

/// @param allow_robot_link false: a link of a robot is refused
/// @return names of the pairs removed with it. @throws Error when there is no such body, or when another one
///         is attached to it
std::vector<std::string> removeBody(Scene& scene, const std::string& name, bool allow_robot_link = false);
/// Appends it without the names of its pairs.
void takeOutBody(Scene& scene, const std::string& name, bool allow_robot_link);
/// Takes out the bodies that are marked, one entry for each. Bodies attached to them do not prevent it.
void takeOutBodies(Scene& scene, const std::vector<bool>& gone);

/// Returns the names of the pairs of a body, 1000 at most of those by rule.
std::vector<std::string> pairNamesOf(const Scene& scene, std::size_t body);

/// Names the pairs of a request: by a name or a pattern or, when that is empty, by the bodies of both sides
/// in either order, each a body, a group or a pattern.
struct PairReference {
  std::string pair;
  std::string body_a;
  std::string body_b;
};

/// Pairs of the two sides that are not watched are created when they are enabled: of two bodies named by
/// themselves also one that a filter left out (adjacent links), listed and with `settings`; of groups and
/// patterns by rule, those that no filter concerns, with the scene's defaults.
/// @return the pairs' names, 1000 at most of groups and patterns. @throws Error when there is no such pair or
/// body
std::vector<std::string> setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                                        const PairSettings& settings);

/// @throws Error when no pair has this name
void requirePair(const Scene& scene, const std::string& name);
/// Index of the body with this name. @throws Error when there is none
std::size_t requireBody(const Scene& scene, const std::string& name);

}  // namespace concave_distance
