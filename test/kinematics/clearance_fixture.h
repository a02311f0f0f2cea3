#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/clearance.h"
#include "support/scene_fixture.h"

namespace concave_distance::test {

inline constexpr double kRounding = 1e-12;  // metres, of scenes of some metres

/// A scene in which something moves.
class ClearanceTest : public SceneTest {
 protected:
  void use(Scene loaded) {
    scene = std::move(loaded);
    joints.emplace(scene);
    state = joints->startState();
  }
  /// Bodies on no robot stay where they are in the world.
  void useBodies(const std::string& bodies, const std::string& more = "") {
    use(load("bodies:\n" + bodies + more));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      state.world_from_body[i] = scene.bodies[i].frame_from_body;
    }
  }
  std::size_t body(const std::string& name) const { return scene.findBody(name).value(); }

  ClearanceResult clearance(const JointMotion& motion) const {
    return findClearance(scene, *joints, state, motion, parameters);
  }
  ClearanceResult clearance(const PoseMotion& motion) const {
    return findClearance(scene, *joints, state, motion, parameters);
  }
  template <typename Motion>
  std::string refusal(const Motion& motion) const {
    try {
      (void)clearance(motion);
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }

  static PoseMotion straight(const std::string& name, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to) {
    PoseMotion motion;
    motion.body = name;
    motion.times = {0.0, 1.0};
    motion.positions = {from, to};
    motion.rotations.resize(2, Eigen::Quaterniond::Identity());
    return motion;
  }
  static JointMotion joint(const std::string& name, const std::vector<double>& positions) {
    JointMotion motion;
    motion.joints = {name};
    motion.positions =
        Eigen::Map<const Eigen::VectorXd>(positions.data(), static_cast<Eigen::Index>(positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i) motion.times.push_back(static_cast<double>(i));
    return motion;
  }

  void requireBracket(const ClearanceResult& result, double truth, double rounding = kRounding) const {
    EXPECT_LE(result.lower_bound, truth + rounding);
    EXPECT_GE(result.distance, truth - rounding);
    EXPECT_GE(result.lower_bound, result.distance - parameters.tolerance);
    EXPECT_NEAR((result.point_b - result.point_a).norm(), result.distance, rounding);
  }

  Scene scene;
  std::optional<SceneKinematics> joints;
  SceneState state;
  ClearanceParameters parameters;
};

}  // namespace concave_distance::test
