#include "attach_bodies.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "concave_distance/base/error.h"
#include "scene/matching_bodies.h"

namespace concave_distance::detail {
namespace {

// The parents of bodies by place; nothing for one that is attached to no body.
using Parents = std::unordered_map<std::size_t, std::optional<std::size_t>>;

bool isNamed(const std::vector<BodySpec>& specs, const std::string& name) {
  for (const BodySpec& spec : specs) {
    if (spec.description.name == name) return true;
  }
  return false;
}

void requireFrame(const AttachmentSpec& attached, const SceneBody& body, const std::string& frame) {
  if (body.frame == frame) return;
  throw Error(attached.parent.where,
              "body '" + body.name + "' is in frame '" + body.frame + "', and '" + attached.parent.text +
                  "' is in '" + frame + "'",
              "write frame: " + frame + ", and placed: where the body is in that frame");
}

void requireNoCycle(const AttachmentSpec& attached, std::size_t body, const Parents& parents) {
  std::set<std::size_t> met{body};
  for (auto at = parents.find(body); at != parents.end() && at->second; at = parents.find(*at->second)) {
    if (met.insert(*at->second).second) continue;
    throw Error(attached.parent.where, "what it is attached to is attached to the body itself: a cycle",
                "leave one of them out");
  }
}

std::optional<std::size_t> parentOf(const AttachmentSpec& attached, const SceneBody& body,
                                    const Scene& scene) {
  const std::string& name = attached.parent.text;
  const std::optional<std::size_t> parent = scene.findBody(name);
  if (!parent && scene.groups.count(name) != 0) {
    throw Error(attached.parent.where, "'" + name + "' is a group", "attach it to one body or frame");
  }
  requireFrame(attached, body, parent ? scene.bodies[*parent].frame : name);
  return parent;
}

Attachment attachmentOf(const AttachmentSpec& attached, const SceneBody& body,
                        const std::optional<std::size_t>& parent, Scene& scene) {
  Attachment made;
  made.parent = attached.parent.text;
  made.parent_from_body = body.frame_from_body;
  if (parent) {
    const SceneBody& carries = scene.bodies[*parent];
    made.parent_serial = carries.serial;
    made.parent_from_body = carries.frame_from_body.inverse(Eigen::Isometry) * body.frame_from_body;
  }
  for (const Selector& selector : attached.may_touch) {
    const std::vector<std::size_t> touched = findMatchingBodies(scene, selector.text).bodies;
    if (touched.empty()) scene.notes.push_back(selector.where + ": '" + selector.text + "' names no body");
    for (const std::size_t other : touched) made.may_touch.insert(scene.bodies[other].serial);
  }
  for (const std::string& pair : attached.switched_off) {
    if (scene.pairs.find(pair)) made.switched_off.push_back(pair);
  }
  made.carrier_before = body.carrier;
  return made;
}

// An edit moves a body alone or with its carrier; attached ones go with their parents.
std::uint64_t carrierOf(std::size_t body, const Parents& parents, const Scene& scene) {
  auto at = parents.find(body);
  while (at != parents.end() && at->second) {
    body = *at->second;
    at = parents.find(body);
  }
  return at == parents.end() ? scene.bodies[body].carrier : 0;
}

}  // namespace

void attachBodies(const std::vector<BodySpec>& specs, Scene& scene) {
  Parents parents;
  std::vector<std::pair<const AttachmentSpec*, std::size_t>> all;
  for (const BodySpec& spec : specs) {
    const std::optional<std::size_t> place = scene.findBody(spec.description.name);
    if (!spec.attached || !place) continue;
    const std::string& parent = spec.attached->parent.text;
    if (!scene.findBody(parent) && isNamed(specs, parent)) {
      scene.problems.push_back(
          {spec.attached->parent.where, "body '" + spec.description.name + "' is not attached to '" + parent +
                                            "', which is not served: it stays where it is"});
      continue;
    }
    all.emplace_back(&*spec.attached, *place);
    parents[*place] = parentOf(*spec.attached, scene.bodies[*place], scene);
  }
  for (const auto& [attached, body] : all) requireNoCycle(*attached, body, parents);
  std::vector<std::uint64_t> carriers;
  for (const auto& [attached, body] : all) carriers.push_back(carrierOf(body, parents, scene));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [attached, place] = all[i];
    Attachment made = attachmentOf(*attached, scene.bodies[place], parents[place], scene);
    SceneBody& body = scene.bodies.edit(place);
    body.attachment = std::make_shared<const Attachment>(std::move(made));
    body.carrier = carriers[i];
  }
}

}  // namespace concave_distance::detail
