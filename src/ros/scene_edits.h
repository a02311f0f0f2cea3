#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// True for at most 200 letters, digits, _ and /, beginning with a letter and without empty parts: usable in
/// topic names.
bool isRosName(const std::string& name);

/// @throws Error when the scene has its largest number of bodies
void requireRoomForBody(const Scene& scene);

/// Which bodies a new one is paired with.
struct PairPartners {
  std::vector<std::string> names;        ///< empty: every body that can move relative to its frame
  bool none = false;                     ///< no body at all
  std::vector<std::string> may_touch{};  ///< bodies left out; not together with `names`
  /// Whether two frames do not move relative to each other, besides those that Scene::rigid joins.
  std::function<bool(const std::string& frame_a, const std::string& frame_b)> is_rigid{};
};

struct AddedPairs {
  std::vector<std::string> names;
  std::vector<std::string> rigid_neighbours;  ///< bodies of other frames left out as rigidly connected
  std::vector<std::string> unknown;           ///< names in PairPartners::may_touch without a body
};

/// Adds a body and its pairs with its partners.
/// @throws Error when the name is taken or not a ROS name, when a partner is unknown or the body itself, or
///         when the scene would exceed its limits
AddedPairs addBody(Scene& scene, SceneBody body, const PairPartners& partners, const PairSettings& settings);

/// @param allow_robot_link false: a link of a robot is refused
/// @return names of the pairs removed with it. @throws Error when there is no such body
std::vector<std::string> removeBody(Scene& scene, const std::string& name, bool allow_robot_link = false);

/// How a request names a pair: by its name or, when that is empty, by its bodies in either order.
struct PairReference {
  std::string pair;
  std::string body_a;
  std::string body_b;
};

/// A pair that a filter left out (adjacent links) is created with `settings` when it is enabled by its
/// bodies.
/// @return the pair's name. @throws Error when there is no such pair or body
std::string setPairEnabled(Scene& scene, const PairReference& reference, bool enabled,
                           const PairSettings& settings);

/// Index of the pair with this name. @throws Error when there is none
std::size_t requirePair(const Scene& scene, const std::string& name);
/// Index of the body with this name. @throws Error when there is none
std::size_t requireBody(const Scene& scene, const std::string& name);

}  // namespace concave_distance
