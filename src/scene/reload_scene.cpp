#include "reload_scene.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

#include "body_placement.h"
#include "body_serials.h"
#include "cloud_bodies.h"
#include "concave_distance/base/error.h"
#include "merged_rules.h"
#include "scene_edits.h"

namespace concave_distance::detail {
namespace {

const SceneBody* bodyNamed(const Scene& scene, const std::string& name) {
  const std::optional<std::size_t> place = scene.findBody(name);
  return place ? &scene.bodies[*place] : nullptr;
}

bool isAttachedAlike(const SceneBody& l, const SceneBody& r) {
  if (!l.attachment || !r.attachment) return !l.attachment && !r.attachment;
  return l.attachment->parent == r.attachment->parent && l.attachment->may_touch == r.attachment->may_touch &&
         l.attachment->carrier_before == r.attachment->carrier_before;
}

bool isPlacedAlike(const SceneBody& l, const SceneBody& r) {
  return l.frame == r.frame && l.frame_from_body.matrix() == r.frame_from_body.matrix() &&
         l.carrier == r.carrier && isAttachedAlike(l, r);
}

void takePlacement(const SceneBody& from, SceneBody& body) {
  body.frame = from.frame;
  body.frame_from_body = from.frame_from_body;
  body.carrier = from.carrier;
  body.attachment = from.attachment;
}

bool areOneCloud(const SceneBody& l, const SceneBody& r) {
  return l.cloud && r.cloud && *l.cloud->settings == *r.cloud->settings && l.frame == r.frame;
}

class Reload {
 public:
  Reload(const Scene& current, Scene fresh, const FramesNow& frames, ReloadReport& report)
      : loaded_(current.loaded ? *current.loaded : Scene()),
        edited_(current),
        fresh_(std::move(fresh)),
        frames_(frames),
        report_(report) {}

  Scene run(bool drop_edits) {
    shareSerials();
    auto as_loaded = std::make_shared<Scene>(fresh_);
    for (std::size_t i = 0; i < as_loaded->bodies.size(); ++i) as_loaded->bodies.edit(i).mesh = nullptr;
    as_loaded->loaded = nullptr;
    Scene scene = drop_edits ? withoutEdits() : withEdits();
    scene.loaded = std::move(as_loaded);
    if (scene.bodies.size() > scene.limits.bodies) {
      throw Error("scene", std::to_string(scene.bodies.size()) + " bodies with those that services added",
                  "the limit is " + std::to_string(scene.limits.bodies) +
                      " (~limits/largest_body_count): remove some, or set drop_edits");
    }
    return scene;
  }

 private:
  // Returns whether a body is the one that was loaded, however it was edited since.
  bool isOfFile(const SceneBody& body) const {
    const SceneBody* loaded = bodyNamed(loaded_, body.name);
    return loaded != nullptr && loaded->serial == body.serial;
  }

  // A body of the same name and mesh is the same; one of another mesh takes the place of the one before.
  void shareSerials() {
    Serials fresh;
    Serials before;
    for (const SceneBody& body : fresh_.bodies) {
      const SceneBody* edited = bodyNamed(edited_, body.name);
      const SceneBody* loaded = bodyNamed(loaded_, body.name);
      if (edited == nullptr || !isOfFile(*edited)) {
        if (loaded == nullptr) report_.added.push_back(body.name);
        continue;
      }
      const bool is_same = (edited->mesh == body.mesh || areOneCloud(*edited, body)) &&
                           edited->is_robot_link == body.is_robot_link;
      (is_same ? fresh : before)
          .emplace(is_same ? body.serial : edited->serial, is_same ? edited->serial : body.serial);
      (is_same ? report_.kept : report_.replaced).push_back(body.name);
    }
    for (const SceneBody& body : edited_.bodies) {
      if (isOfFile(body) && !fresh_.findBody(body.name)) report_.removed.push_back(body.name);
    }
    for (const SceneBody& body : edited_.bodies) {
      if (!isOfFile(body)) added_.insert(body.name);
    }
    keepClouds();
    renumber(fresh_, fresh);
    renumber(edited_, before);
    renumber(loaded_, before);
  }

  // A sensor goes on seeing.
  void keepClouds() {
    for (std::size_t i = 0; i < fresh_.bodies.size(); ++i) {
      const SceneBody* edited = bodyNamed(edited_, fresh_.bodies[i].name);
      if (edited == nullptr || !isOfFile(*edited) || !areOneCloud(*edited, fresh_.bodies[i])) continue;
      takeCloud(fresh_.bodies.edit(i), *edited->cloud, edited->mesh, edited->frame_from_body);
    }
  }

  Scene withoutEdits() {
    for (const SceneBody& body : edited_.bodies) {
      if (added_.count(body.name) != 0)
        report_.dropped.push_back("body '" + body.name + "', which a service had added");
    }
    for (const SceneBody& body : loaded_.bodies) {
      if (!edited_.findBody(body.name) && fresh_.findBody(body.name)) report_.added.push_back(body.name);
    }
    return fresh_;
  }

  Scene withEdits() {
    Scene scene = fresh_;
    scene.bodies = NamedList<SceneBody>();
    for (std::size_t i = 0; i < fresh_.bodies.size(); ++i) {
      const SceneBody& body = fresh_.bodies[i];
      const SceneBody* edited = bodyNamed(edited_, body.name);
      const SceneBody* loaded = bodyNamed(loaded_, body.name);
      if (loaded != nullptr && (edited == nullptr || added_.count(body.name) != 0)) {
        if (edited == nullptr) report_.kept_edits.push_back(body.name);  // an edit has removed it
        continue;
      }
      if (edited != nullptr && loaded == nullptr) {
        report_.dropped.push_back(
            "body '" + body.name +
            "', which a service had added: a body of the scene's files has its name now");
        added_.erase(body.name);
      }
      scene.bodies.appendShared(fresh_.bodies, i);
    }
    for (std::size_t i = 0; i < edited_.bodies.size(); ++i) {
      const std::string& name = edited_.bodies[i].name;
      if (added_.count(name) == 0) continue;
      scene.bodies.appendShared(edited_.bodies, i);
      report_.kept_edits.push_back(name);
    }
    detachFromGone(scene);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) keepEditsOf(i, scene);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) endCycle(i, scene);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) followParent(i, scene);
    for (const auto& [a, b] : edited_.joined_by_tf) {
      if (scene.rigid.areJoined(a, b)) continue;
      scene.rigid.join(a, b);
      scene.joined_by_tf.emplace_back(a, b);
    }
    mergeRules(loaded_, edited_, fresh_, scene);
    return scene;
  }

  // They stay where they are.
  void detachFromGone(const Scene& scene) {
    for (std::size_t i = 0; i < edited_.bodies.size(); ++i) {
      const std::string name = edited_.bodies[i].name;
      const std::shared_ptr<const Attachment> attachment = edited_.bodies[i].attachment;
      if (!attachment || attachment->parent_serial == 0 || scene.findBody(attachment->parent) ||
          !scene.findBody(name))
        continue;
      std::string where;
      try {
        detachBody(edited_, name, "", frames_);
        where = "it stays where it is, in '" + frames_.reference + "'";
      } catch (const Error& error) {
        SceneBody& body = edited_.bodies.edit(i);
        body.attachment = nullptr;
        body.carrier = attachment->carrier_before;
        where = "it stays in frame '" + body.frame + "', because " + error.whatIsWrong();
      }
      noteDropped(name, *attachment, ", which is gone: " + where);
    }
  }

  void noteDropped(const std::string& body, const Attachment& attachment, const std::string& why) {
    report_.dropped.push_back("attachment of '" + body + "' to '" + attachment.parent + "'" + why);
  }

  void keepEditsOf(std::size_t place, Scene& scene) {
    const SceneBody& body = scene.bodies[place];
    const SceneBody* edited = bodyNamed(edited_, body.name);
    const SceneBody* loaded = bodyNamed(loaded_, body.name);
    if (edited == nullptr) return;
    if (added_.count(body.name) != 0) {
      takePlacement(*edited, scene.bodies.edit(place));
      return;
    }
    if (loaded == nullptr) return;
    if (edited->margin != loaded->margin) {
      try {
        if (limitsMargin(body)) requireMargin("body '" + body.name + "'", edited->margin, *body.mesh);
        scene.bodies.edit(place).margin = edited->margin;
      } catch (const Error& error) {
        report_.dropped.push_back("margin of '" + body.name + "': " + error.whatIsWrong());
      }
    }
    if (!body.is_robot_link && !isPlacedAlike(*edited, *loaded))
      takePlacement(*edited, scene.bodies.edit(place));
  }

  // The files may attach a body to one that an edit has attached to it.
  void endCycle(std::size_t place, Scene& scene) {
    std::unordered_set<std::size_t> met;
    std::optional<std::size_t> at = place;
    while (at && met.insert(*at).second) {
      const std::shared_ptr<const Attachment>& attachment = scene.bodies[*at].attachment;
      at = attachment && attachment->parent_serial != 0 ? scene.findBody(attachment->parent) : std::nullopt;
    }
    if (at != place) return;
    SceneBody& body = scene.bodies.edit(place);
    noteDropped(body.name, *body.attachment, ": it would be attached to itself, through others");
    body.carrier = body.attachment->carrier_before;
    body.attachment = nullptr;
  }

  // Attached bodies go with their parent where that is somewhere else than before.
  void followParent(std::size_t place, Scene& scene) {
    const std::shared_ptr<const Attachment> attachment = scene.bodies[place].attachment;
    if (!attachment || attachment->parent_serial == 0) return;
    const std::optional<std::size_t> parent = scene.findBody(attachment->parent);
    if (!parent) return;
    followParent(*parent, scene);
    const SceneBody& carries = scene.bodies[*parent];
    const SceneBody* before = bodyNamed(edited_, carries.name);
    SceneBody& body = scene.bodies.edit(place);
    if (before == nullptr || before->frame != carries.frame ||
        before->frame_from_body.matrix() != carries.frame_from_body.matrix()) {
      body.frame = carries.frame;
      body.frame_from_body = carries.frame_from_body * attachment->parent_from_body;
    }
    body.carrier = carries.carrier;
    if (attachment->parent_serial == carries.serial) return;
    Attachment renewed = *attachment;
    renewed.parent_serial = carries.serial;
    body.attachment = std::make_shared<const Attachment>(std::move(renewed));
  }

  Scene loaded_;
  Scene edited_;
  Scene fresh_;
  const FramesNow& frames_;
  ReloadReport& report_;
  std::unordered_set<std::string> added_;  ///< bodies that services added
};

}  // namespace

Scene reloadedScene(const Scene& current, Scene fresh, bool drop_edits, const FramesNow& frames,
                    ReloadReport& report) {
  return Reload(current, std::move(fresh), frames, report).run(drop_edits);
}

}  // namespace concave_distance::detail
