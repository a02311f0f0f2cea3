#include "matching_bodies.h"

#include <algorithm>
#include <set>

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

std::vector<bool> standingFor(const Scene& scene, const std::string& group) {
  std::vector<bool> listed(scene.bodies.size(), false);
  std::set<std::string> frames;  // of its links, by RigidFrames::rootOf()
  for (const std::size_t body : findMatchingBodies(scene, group).bodies) {
    listed[body] = true;
    if (scene.bodies[body].is_robot_link) frames.insert(scene.rigid.rootOf(scene.bodies[body].frame));
  }
  std::vector<bool> stands = listed;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    // Along the chain of attachments to its end.
    for (const Attachment* next = scene.bodies[i].attachment.get(); next != nullptr && !stands[i];) {
      const auto parent = next->parent_serial == 0 ? std::nullopt : scene.findBody(next->parent);
      stands[i] = parent ? listed[*parent] : frames.count(scene.rigid.rootOf(next->parent)) != 0;
      next = parent ? scene.bodies[*parent].attachment.get() : nullptr;
    }
  }
  return stands;
}

std::size_t countFacing(const Scene& scene, const std::vector<bool>& stands) {
  const BodySet inside = BodySet::marked(stands);
  const BodySet outside = BodySet::before(stands.size()) - inside;
  return countPairsByRule(scene, {{inside, outside}, {outside, inside}});
}

}  // namespace concave_distance::detail
