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

/// Returns which bodies of a scene stand for a group: its members, and what is attached to one of them or to
/// a frame that moves with a robot's link among them.
std::vector<bool> standingFor(const Scene& scene, const std::string& group);
/// Counts the enabled pairs by rule of which one body stands for the group and the other does not.
std::size_t countFacing(const Scene& scene, const std::vector<bool>& stands);

}  // namespace concave_distance::detail
