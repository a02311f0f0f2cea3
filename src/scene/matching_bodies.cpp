#include "matching_bodies.h"

#include <algorithm>

#include "concave_distance/base/error.h"
#include "name_pattern.h"

namespace concave_distance::detail {

MatchingBodies findMatchingBodies(const Scene& scene, const std::string& text) {
  if (const auto body = scene.findBody(text)) return {{*body}, true};
  MatchingBodies found;
  if (const auto group = scene.groups.find(text); group != scene.groups.end()) {
    for (const std::string& member : group->second) {
      if (const auto body = scene.findBody(member)) found.bodies.push_back(*body);
    }
  } else if (isPattern(text)) {
    requirePatternLength(text, "body");
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (matchesPattern(text, scene.bodies[i].name)) found.bodies.push_back(i);
    }
  }
  return found;
}

MatchingBodies matchingBodies(const Scene& scene, const std::string& text, const std::string& where) {
  MatchingBodies found = findMatchingBodies(scene, text);
  if (!found.bodies.empty()) return found;
  if (scene.groups.count(text) != 0) {
    throw Error(where, "no body of group '" + text + "' is in the scene", "list_bodies has the names of all");
  }
  std::string groups;
  for (const auto& group : scene.groups) groups += (groups.empty() ? "" : ", ") + group.first;
  throw Error(where, isPattern(text) ? "'" + text + "' matches no body" : "there is no body '" + text + "'",
              "list_bodies has their names; groups: " + (groups.empty() ? "none" : groups));
}

}  // namespace concave_distance::detail
