#pragma once

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
  std::vector<std::string> names;  ///< empty: every body of another frame
  bool none = false;               ///< no body at all
};

/// Adds a body and its pairs with its partners.
/// @return names of the new pairs
/// @throws Error when the name is taken or no ROS name, a partner is unknown or the body itself, or the scene
///         would be beyond its limits
std::vector<std::string> addBody(Scene& scene, SceneBody body, const PairPartners& partners,
                                 const PairSettings& settings);

/// @return names of the pairs that went with it. @throws Error when there is no such body
std::vector<std::string> removeBody(Scene& scene, const std::string& name);

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
