#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// The bodies of a scene that a text calls: one by its name, those of a group, or those that
/// a pattern matches.
struct MatchingBodies {
  std::vector<std::size_t> bodies;  ///< each once
  bool is_one_by_name = false;
};

/// Empty when there are none.
MatchingBodies findMatchingBodies(const Scene& scene, const std::string& text);

/// The same. @param where names the field of a request in the error
/// @throws Error when there are none
MatchingBodies matchingBodies(const Scene& scene, const std::string& text, const std::string& where);

}  // namespace concave_distance::detail
