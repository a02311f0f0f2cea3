#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// True for letters, digits, _ and /, beginning with a letter and without empty parts, 200 of them at the
/// most: usable in topic names.
bool isRosName(const std::string& name);

/// @throws Error when the scene has as many bodies as it may have
void requireRoomForBody(const Scene& scene);

/// Which bodies a new one is paired with.
struct PairPartners {
  std::vector<std::string> names;        ///< empty: every body that can move against the new one's frame
  bool none = false;                     ///< no body at all
  std::vector<std::string> may_touch{};  ///< bodies left out; not together with `names`
  /// Whether two frames are known to stand still against each other, besides those that Scene::rigid joins.
  std::function<bool(const std::string& frame_a, const std::string& frame_b)> is_rigid{};
};

struct AddedPairs {
  std::vector<std::string> names;
  std::vector<std::string> rigid_neighbours;  ///< bodies of other frames left out: nothing moves them apart
  std::vector<std::string> unknown;           ///< of PairPartners::may_touch: names of no body
};

/// Adds a body and its pairs with its partners.
/// @throws Error when the name is taken or no ROS name, a partner is unknown or the body itself, or the scene
///         would be beyond its limits
AddedPairs addBody(Scene& scene, SceneBody body, const PairPartners& partners, const PairSettings& settings);

/// @param allow_robot_link false: a link of a robot is refused
/// @return names of the pairs that went with it. @throws Error when there is no such body
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
