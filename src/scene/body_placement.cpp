#include "body_placement.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "concave_distance/base/error.h"
#include "equal_settings.h"
#include "matching_bodies.h"
#include "scene_edits.h"

namespace concave_distance::detail {
namespace {

std::string whereOf(const std::string& name) {
  return "body '" + name + "'";
}

std::optional<FrameRelation> relate(const FramesNow& frames, const std::string& target,
                                    const std::string& source) {
  if (target == source) return FrameRelation{Eigen::Isometry3d::Identity(), true};
  return frames.relation ? frames.relation(target, source) : std::nullopt;
}

std::size_t requireMovable(const Scene& scene, const std::string& name) {
  const std::size_t index = requireBody(scene, name);
  if (scene.bodies[index].is_robot_link) {
    throw Error(whereOf(name), "it is a link of a robot, which tf moves", "move the robot's joints");
  }
  if (scene.bodies[index].cloud) {
    throw Error(whereOf(name), "it is a cloud, which stands where the sensor sees it", "move the sensor");
  }
  return index;
}

Eigen::Isometry3d poseIn(const std::string& frame, const SceneBody& body, const FramesNow& frames) {
  const std::optional<FrameRelation> relation = relate(frames, frame, body.frame);
  if (!relation) {
    throw Error(whereOf(body.name), "there is no transform from '" + body.frame + "' to '" + frame + "'",
                "try again when something publishes it");
  }
  return relation->target_from_source * body.frame_from_body;
}

bool isAsItsRule(const Scene& scene, const ScenePair& pair) {
  const auto [earlier, later] = std::minmax(pair.body_a, pair.body_b);
  const PairRule& rule = scene.rules.of(earlier, later);
  return pair.is_from_rule && rule.is_watched && pair.enabled == rule.is_enabled &&
         haveEqualSettings(pair.settings, settingsOf(scene, rule));
}

// Pairs that are listed for their topics alone and are as their rule has them follow it again when nothing
// moves their bodies against each other any more.
void unlistResting(Scene& scene, std::size_t body, const std::vector<std::string>& kept) {
  const auto rests = [&](const ScenePair& pair) {
    return (pair.body_a == body || pair.body_b == body) &&
           areRigid(scene, scene.bodies[pair.body_a], scene.bodies[pair.body_b]) &&
           isAsItsRule(scene, pair) && std::find(kept.begin(), kept.end(), pair.name) == kept.end();
  };
  if (std::none_of(scene.pairs.begin(), scene.pairs.end(), rests)) return;
  PairList others;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    if (!rests(scene.pairs[i])) others.appendShared(scene.pairs, i);
  }
  scene.pairs = std::move(others);
}

// Places what is attached to a body, and to that in turn.
void carryAlong(Scene& scene, std::size_t parent) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::shared_ptr<const Attachment> attachment = scene.bodies[i].attachment;
    if (!attachment || attachment->parent_serial != scene.bodies[parent].serial) continue;
    SceneBody& body = scene.bodies.edit(i);
    body.frame = scene.bodies[parent].frame;
    body.frame_from_body = scene.bodies[parent].frame_from_body * attachment->parent_from_body;
    body.carrier = scene.bodies[parent].carrier;
    unlistResting(scene, i, {});
    carryAlong(scene, i);
  }
}

void requireNoCycle(const Scene& scene, std::size_t body, std::size_t parent) {
  const std::string& name = scene.bodies[body].name;
  if (body == parent)
    throw Error(whereOf(name), "it would be attached to itself", "name another body or frame");
  for (std::optional<std::size_t> at = parent; at && scene.bodies[*at].attachment;) {
    at = scene.findBody(scene.bodies[*at].attachment->parent_serial);
    if (at == body) {
      throw Error(
          whereOf(name),
          "'" + scene.bodies[parent].name + "' is attached to it already, perhaps through others: a cycle",
          "detach '" + scene.bodies[parent].name + "' first");
    }
  }
}

/// Where a body will be attached.
struct Parent {
  std::string frame;
  Eigen::Isometry3d frame_from_parent = Eigen::Isometry3d::Identity();
  std::uint64_t serial = 0;
  std::uint64_t carrier = 0;
};

Parent bodyAsParent(const Scene& scene, std::size_t body, std::size_t parent) {
  requireNoCycle(scene, body, parent);
  const SceneBody& carries = scene.bodies[parent];
  return {carries.frame, carries.frame_from_body, carries.serial, carries.carrier};
}

Parent frameAsParent(const std::string& frame) {
  return {frame, Eigen::Isometry3d::Identity(), 0, 0};
}

Parent parentNamed(const Scene& scene, std::size_t body, const std::string& name, const FramesNow& frames) {
  if (const std::optional<std::size_t> index = scene.findBody(name)) return bodyAsParent(scene, body, *index);
  if (scene.groups.count(name) != 0) {
    throw Error(whereOf(scene.bodies[body].name), "'" + name + "' is a group",
                "attach it to one body or frame");
  }
  if (name.empty() || !relate(frames, frames.reference, name)) {
    throw Error(whereOf(scene.bodies[body].name), "there is neither a body nor a tf frame '" + name + "'",
                "list_bodies has the names of bodies");
  }
  return frameAsParent(name);
}

void requireUnattached(const SceneBody& body) {
  if (!body.attachment) return;
  throw Error(whereOf(body.name), "it is attached to '" + body.attachment->parent + "' already",
              "detach it first");
}

void requireNotCarried(const SceneBody& body) {
  if (!body.attachment) return;
  throw Error(whereOf(body.name), "it is attached to '" + body.attachment->parent + "', which moves it",
              "detach it first");
}

void switchOffTouching(Scene& scene, std::size_t body, Attachment& attachment) {
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const ScenePair& pair = scene.pairs[i];
    if (!pair.enabled || (pair.body_a != body && pair.body_b != body)) continue;
    const SceneBody& other = scene.bodies[pair.body_a == body ? pair.body_b : pair.body_a];
    if (attachment.may_touch.count(other.serial) == 0 && !areRigid(scene, scene.bodies[body], other))
      continue;
    attachment.switched_off.push_back(pair.name);
    scene.pairs.edit(i).enabled = false;
  }
}

// Where its pose in the parent puts it, so that a journal puts it there, too.
std::vector<std::string> attach(Scene& scene, std::size_t index, const std::string& name,
                                const Parent& parent, const Eigen::Isometry3d& parent_from_body,
                                const std::vector<std::string>& may_touch) {
  auto attachment = std::make_shared<Attachment>();
  attachment->parent = name;
  attachment->parent_serial = parent.serial;
  attachment->parent_from_body = parent_from_body;
  attachment->carrier_before = scene.bodies[index].carrier;
  std::vector<std::string> unknown;
  for (const std::string& text : may_touch) {
    const std::vector<std::size_t> bodies = findMatchingBodies(scene, text).bodies;
    if (bodies.empty()) unknown.push_back(text);
    for (const std::size_t other : bodies) attachment->may_touch.insert(scene.bodies[other].serial);
  }
  SceneBody& body = scene.bodies.edit(index);
  body.frame = parent.frame;
  body.frame_from_body = parent.frame_from_parent * parent_from_body;
  body.carrier = parent.carrier;
  switchOffTouching(scene, index, *attachment);
  body.attachment = std::move(attachment);
  carryAlong(scene, index);
  return unknown;
}

// What is attached to the body goes with it.
void place(Scene& scene, std::size_t index, std::string frame, const Eigen::Isometry3d& frame_from_body,
           std::uint64_t carrier) {
  SceneBody& body = scene.bodies.edit(index);
  body.frame = std::move(frame);
  body.frame_from_body = frame_from_body;
  body.carrier = carrier;
  carryAlong(scene, index);
}

void release(Scene& scene, std::size_t index, const std::string& frame,
             const Eigen::Isometry3d& frame_from_body) {
  const std::shared_ptr<const Attachment> attachment = scene.bodies[index].attachment;
  scene.bodies.edit(index).attachment = nullptr;
  place(scene, index, frame, frame_from_body, attachment->carrier_before);
  for (const std::string& pair : attachment->switched_off) {
    if (const auto listed = scene.pairs.find(pair)) scene.pairs.edit(*listed).enabled = true;
  }
  unlistResting(scene, index, attachment->switched_off);
}

}  // namespace

void moveBody(Scene& scene, const std::string& name, const std::string& frame,
              const Eigen::Isometry3d& frame_from_body, const FramesNow& frames) {
  const std::size_t index = requireMovable(scene, name);
  const SceneBody& before = scene.bodies[index];
  requireNotCarried(before);
  if (!frame_from_body.matrix().allFinite()) {
    throw Error(whereOf(name), "the pose is not finite", "give finite numbers");
  }
  const std::optional<FrameRelation> known =
      relate(frames, frames.reference, frame.empty() ? before.frame : frame);
  if (frame.empty() && !(known && known->is_fixed)) {
    throw Error(whereOf(name), "tf moves its frame '" + before.frame + "'",
                "give the frame of the pose, which the body is in from then on");
  }
  if (!known) {
    throw Error(whereOf(name), "tf does not connect '" + frame + "' and '" + frames.reference + "'",
                "check the name, or try again when something publishes it");
  }
  place(scene, index, frame.empty() ? before.frame : frame, frame_from_body, before.serial);
}

void placeBody(Scene& scene, const std::string& name, const std::string& frame,
               const Eigen::Isometry3d& frame_from_body, bool is_moved) {
  const std::size_t index = requireMovable(scene, name);
  if (is_moved) requireNotCarried(scene.bodies[index]);
  if (scene.bodies[index].attachment) {
    release(scene, index, frame, frame_from_body);
    return;
  }
  place(scene, index, frame, frame_from_body,
        is_moved ? scene.bodies[index].serial : scene.bodies[index].carrier);
}

std::vector<std::string> attachBody(Scene& scene, const std::string& name, const std::string& parent_name,
                                    const std::vector<std::string>& may_touch, const FramesNow& frames) {
  const std::size_t index = requireMovable(scene, name);
  requireUnattached(scene.bodies[index]);
  const Parent parent = parentNamed(scene, index, parent_name, frames);
  const Eigen::Isometry3d frame_from_body = poseIn(parent.frame, scene.bodies[index], frames);
  return attach(scene, index, parent_name, parent,
                parent.frame_from_parent.inverse(Eigen::Isometry) * frame_from_body, may_touch);
}

std::vector<std::string> attachBodyAt(Scene& scene, const std::string& name, const std::string& parent,
                                      const std::string& frame, const Eigen::Isometry3d& parent_from_body,
                                      const std::vector<std::string>& may_touch) {
  const std::size_t index = requireMovable(scene, name);
  requireUnattached(scene.bodies[index]);
  if (!frame.empty()) return attach(scene, index, parent, frameAsParent(frame), parent_from_body, may_touch);
  const std::optional<std::size_t> found = scene.findBody(parent);
  if (!found) {
    throw Error(whereOf(name), "there is no body '" + parent + "', which it was attached to",
                "attach it to another one: it is where it was before");
  }
  return attach(scene, index, parent, bodyAsParent(scene, index, *found), parent_from_body, may_touch);
}

void detachBody(Scene& scene, const std::string& name, const std::string& frame, const FramesNow& frames) {
  const std::size_t index = requireMovable(scene, name);
  const SceneBody& before = scene.bodies[index];
  if (!before.attachment) {
    throw Error(whereOf(name), "it is not attached", "attach it first, or leave this operation out");
  }
  const std::string& target = frame.empty() ? frames.reference : frame;
  release(scene, index, target, poseIn(target, before, frames));
}

}  // namespace concave_distance::detail
