#include <cmath>
#include <string>
#include <utility>

#include "base/constants.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "motion_paths.h"
#include "tracking/rigid_pose.h"
#include "waypoint_turns.h"
#include "waypoints.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

std::size_t requireMovedBody(const Scene& scene, const std::string& name) {
  const auto body = scene.findBody(name);
  if (body) return *body;
  throw Error(
      "body '" + name + "'", "the scene has no such body",
      scene.bodies.size() == 0 ? "add it first" : "name one of its bodies, as list_bodies gives them");
}

Quaternions requirePoses(const PoseMotion& motion) {
  if (motion.positions.size() != motion.rotations.size()) {
    throw Error(
        "motion",
        counted(motion.positions.size(), "position") + " and " + counted(motion.rotations.size(), "rotation"),
        "give one of each for each waypoint");
  }
  Quaternions rotations;
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    const std::string where = "waypoint " + std::to_string(i);
    if (!(motion.positions[i].cwiseAbs().maxCoeff() <= kLargestCoordinate)) {
      throw Error(where, "its position is not finite, or beyond 1e18 m", "give metres");
    }
    const double norm = motion.rotations[i].norm();
    if (!(std::abs(norm - 1.0) <= kUnitTolerance)) {
      throw Error(where, "the norm of its quaternion is " + numberText(norm),
                  "give a unit quaternion; no rotation is w: 1");
    }
    rotations.push_back(motion.rotations[i].normalized());
  }
  return rotations;
}

/// Returns what moves with a body: itself and what is attached to it, or to what is.
std::vector<bool> movedWith(const Scene& scene, std::size_t body) {
  std::vector<bool> is_moved(scene.bodies.size(), false);
  is_moved[body] = true;
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const auto& attachment = scene.bodies[i].attachment;
      if (is_moved[i] || !attachment || attachment->parent_serial == 0) continue;
      for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        if (!is_moved[k] || scene.bodies[k].serial != attachment->parent_serial) continue;
        is_moved[i] = has_grown = true;
      }
    }
  }
  return is_moved;
}

}  // namespace

MotionPaths pathsOf(const Scene& scene, const SceneKinematics& joints, const SceneState& state,
                    const PoseMotion& motion) {
  const std::size_t moved = requireMovedBody(scene, motion.body);
  const Quaternions rotations = requirePoses(motion);
  MotionPaths paths;
  paths.times = requireTimes(motion.times, motion.positions.size(), [&](std::size_t i) {
    return motion.positions[i] == motion.positions[i - 1] &&
           motion.rotations[i].coeffs() == motion.rotations[i - 1].coeffs();
  });
  for (const PathElement& element :
       addPoses(motion.positions, rotations, Eigen::Isometry3d::Identity(), paths)) {
    paths.elements.push_back(element);
  }
  const std::vector<bool> is_moved = movedWith(scene, moved);
  for (std::size_t body = 0; body < joints.bodyCount(); ++body) {
    const auto& pose = state.world_from_body[body];
    const auto rigid = pose ? rigidPose(*pose) : std::nullopt;
    std::optional<BodyPath>& path = paths.bodies.emplace_back();
    if (body == moved) {
      path = BodyPath{{0, 1}, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()};
    } else if (!rigid) {
      continue;
    } else if (!is_moved[body]) {
      path = BodyPath{{}, *rigid, Eigen::Isometry3d::Identity()};
    } else if (const auto of_moved =
                   state.world_from_body[moved] ? rigidPose(*state.world_from_body[moved]) : std::nullopt) {
      path = BodyPath{{0, 1}, Eigen::Isometry3d::Identity(), of_moved->inverse(Eigen::Isometry) * *rigid};
    }
  }
  return paths;
}

}  // namespace concave_distance::detail
