#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// True for letters, digits, _ and /, beginning with a letter and without empty parts: usable in topic names.
bool isRosName(const std::string& name);

/// Adds a body and its pairs with the bodies named, or with every body of another frame when none is.
/// @return names of the new pairs
/// @throws Error when the name is taken or no ROS name, or a partner is unknown or the body itself
std::vector<std::string> addBody(Scene& scene, SceneBody body, const std::vector<std::string>& pair_with,
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
