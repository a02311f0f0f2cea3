#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/apply_operations.h"
#include "scene/scene_edits.h"
#include "support/box_scene.h"

namespace concave_distance::test::operations {

using namespace detail;

inline Eigen::Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Holds frames of tf by their poses in the world.
struct Frames {
  std::map<std::string, Eigen::Isometry3d> world_from{
      {"world", at(0)}, {"hand", at(0, 0, 5)}, {"arm", at(0, 0, 9)}, {"bench", at(9)}};
  std::set<std::string> moving{"hand", "arm"};

  FramesNow now() const {
    return {"world", [this](const std::string& target, const std::string& source) {
              std::optional<FrameRelation> relation;
              if (world_from.count(target) == 0 || world_from.count(source) == 0) return relation;
              relation.emplace();
              relation->target_from_source = world_from.at(target).inverse() * world_from.at(source);
              relation->is_fixed = moving.count(target) == 0 && moving.count(source) == 0;
              return relation;
            }};
  }
};

inline SceneBody body(const std::string& name, const std::string& frame,
                      const Eigen::Isometry3d& pose = at(0)) {
  static const SceneBody kBox = unitBox("box");
  SceneBody result = kBox;
  result.name = name;
  result.frame = frame;
  result.frame_from_body = pose;
  return result;
}

/// Two links of a robot, a table and two boxes.
inline Scene cell() {
  Scene scene;
  scene.defaults.pairs.tracker.cold.population_size = 40;
  for (const char* link : {"hand", "arm"}) {
    SceneBody added = body(link, link);
    added.is_robot_link = true;
    addBody(scene, added, {}, scene.defaults.pairs);
  }
  for (const auto& [name, x] : {std::pair("table", 0.0), std::pair("box", 3.0), std::pair("peg", 6.0)}) {
    addBody(scene, body(name, "world", at(x)), {}, scene.defaults.pairs);
  }
  scene.groups["gripper"] = {"hand"};
  return scene;
}

inline SceneOperation operation(OperationKind kind, const std::string& name, const std::string& other = "") {
  SceneOperation result;
  result.kind = kind;
  result.body = name;
  result.other = other;
  return result;
}
inline SceneOperation add(const SceneBody& added) {
  SceneOperation result = operation(OperationKind::Add, added.name);
  result.added = added;
  return result;
}
inline SceneOperation move(const std::string& name, const Eigen::Isometry3d& pose,
                           const std::string& frame = "") {
  SceneOperation result = operation(OperationKind::Move, name);
  result.frame_from_body = pose;
  result.frame = frame;
  return result;
}
inline SceneOperation attach(const std::string& name, const std::string& parent,
                             const std::vector<std::string>& touch = {}) {
  SceneOperation result = operation(OperationKind::Attach, name, parent);
  result.touch_links = touch;
  return result;
}
inline SceneOperation detach(const std::string& name, const std::string& frame = "") {
  SceneOperation result = operation(OperationKind::Detach, name);
  result.frame = frame;
  return result;
}
inline SceneOperation margin(const std::string& name, double metres) {
  SceneOperation result = operation(OperationKind::SetMargin, name);
  result.margin = metres;
  return result;
}

inline AppliedOperations run(Scene& scene, const std::vector<SceneOperation>& operations,
                             const Frames& frames = {}) {
  return applyOperations(scene, operations, frames.now());
}

inline std::vector<std::optional<Eigen::Isometry3d>> posesOf(const Scene& scene, const Frames& frames) {
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  for (const SceneBody& each : scene.bodies) {
    poses.emplace_back(frames.world_from.at(each.frame) * each.frame_from_body);
  }
  return poses;
}

}  // namespace concave_distance::test::operations
