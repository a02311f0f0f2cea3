#include "concave_distance/kinematics/scene_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "support/scene_fixture.h"

namespace concave_distance::scene_kinematics_test {
namespace {

constexpr double kRounding = 1e-14;

std::string turningRobot(const std::string& slash = "") {
  return test::robot(test::boxLink(slash + "a") + test::boxLink(slash + "b") +
                     "<joint name='turn' type='revolute'><origin xyz='2 0 0'/><parent link='" + slash +
                     "a'/><child link='" + slash +
                     "b'/><axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>");
}

class SceneKinematicsTest : public test::SceneTest {
 protected:
  Scene twoRobots() {
    options.descriptions["one"] = options.descriptions["two"] = turningRobot();
    return load(
        "defaults: {max_edge_length: 100}\nrobots:\n  - {description: one, prefix: l_}\n"
        "  - {description: two, prefix: r_}\n"
        "bodies:\n  - {name: wall, frame: world, box: {size: [1, 1, 1]}}\n"
        "  - {name: cart, frame: cart, box: {size: [1, 1, 1]}}\n  - {name: tool, frame: r_b, box: {size: [1, "
        "1, 1]}}\n");
  }
  template <typename Act>
  std::string messageOf(const Act& act) {
    try {
      act();
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }
};

TEST_F(SceneKinematicsTest, PlacesTheBodiesOfAllRobotsByOneVector) {
  Scene scene = twoRobots();
  scene.bodies.edit(6).frame_from_body = Eigen::Translation3d(0, 0, 1);
  ASSERT_EQ(test::bodyNames(scene),
            (std::vector<std::string>{"l_a", "l_b", "r_a", "r_b", "wall", "cart", "tool"}));
  const SceneKinematics joints(scene);
  EXPECT_EQ(joints.positionNames(), (std::vector<std::string>{"l_turn", "r_turn"}));
  EXPECT_EQ(joints.velocityNames(), joints.positionNames());
  SceneState state = joints.startState();
  EXPECT_TRUE(state.world_from_body[4].has_value());
  EXPECT_FALSE(state.world_from_body[5].has_value()) << "nobody knows where the cart is";
  state.robots[1].world_from_link.front() = Eigen::Translation3d(0, 5, 0);
  joints.evaluate(joints.positionsOf({"r_turn", "l_turn"}, {0.5, -0.25}), state);
  const auto turned = [](double y, double angle, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(2, y, 0) *
                             Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                             Eigen::Translation3d(0, 0, z));
  };
  EXPECT_TRUE(state.world_from_body[1]->isApprox(turned(0, -0.25, 0), kRounding));
  EXPECT_TRUE(state.world_from_body[3]->isApprox(turned(5, 0.5, 0), kRounding));
  EXPECT_TRUE(state.world_from_body[6]->isApprox(turned(5, 0.5, 1), kRounding)) << "on the link";
  ASSERT_TRUE(joints.placeOf(6).has_value());
  EXPECT_EQ(joints.placeOf(6)->robot, 1U);
  EXPECT_FALSE(joints.placeOf(4).has_value());
}

TEST_F(SceneKinematicsTest, PlacesLinksWithALeadingSlash) {
  const Scene scene = loadRobotScene(turningRobot("/"), "URDF", options);
  const SceneKinematics joints(scene);
  SceneState state = joints.startState();
  joints.evaluate(Eigen::VectorXd::Constant(1, 3.0), state);
  ASSERT_EQ(state.world_from_body.size(), 2U);
  EXPECT_EQ(state.world_from_body[1]->translation(), Eigen::Vector3d(2.0, 0.0, 0.0));
}

TEST_F(SceneKinematicsTest, SaysWhichJointsOfWhichRobotAreWrong) {
  Scene scene = twoRobots();
  const SceneKinematics joints(scene);
  const auto named = joints.positionsOfRobots({"r_turn"}, {0.5});
  EXPECT_FALSE(named[0].has_value());
  EXPECT_EQ((*named[1])[0], 0.5);
  const auto message = [&](const std::vector<std::string>& names, const std::vector<double>& values) {
    return messageOf([&] { joints.positionsOf(names, values); });
  };
  using test::mentions;
  EXPECT_TRUE(mentions(message({"r_turn"}, {0.5}), "robot 'l_arm': l_turn missing"));
  EXPECT_TRUE(
      mentions(message({"r_turn", "turn"}, {0.5, 0.5}), "joint 'turn': no robot of the scene has it"));
  EXPECT_TRUE(mentions(message({"r_turn", "l_turn"}, {0.5}), "2 names and 1 position"));
  EXPECT_TRUE(
      mentions(message({"r_turn", "l_turn"}, {0.5, std::nan("")}), "'l_turn': its position is not finite"));
  SceneState state = joints.startState();
  EXPECT_TRUE(
      mentions(messageOf([&] { joints.evaluate(Eigen::VectorXd::Zero(3), state); }), "3 numbers (give 2"));
}

TEST_F(SceneKinematicsTest, KnowsTheJointsOfARobotThatHasLeft) {
  Scene scene = twoRobots();
  Scene without = scene;
  without.bodies = {};
  for (const SceneBody& body : scene.bodies) {
    if (body.name.rfind("l_", 0) == 0) without.bodies.push_back(body);
  }
  const SceneKinematics joints(without);
  EXPECT_EQ(joints.positionNames(), std::vector<std::string>{"l_turn"});
  EXPECT_TRUE(test::mentions(messageOf([&] {
                               joints.positionsOf({"l_turn", "r_turn"}, {0, 0});
                             }),
                             "joint 'r_turn': its robot 'r_arm' has no body in the scene any more"));
}

TEST_F(SceneKinematicsTest, RefusesTwoRobotsWithTheSameJoints) {
  options.descriptions["one"] = turningRobot();
  options.descriptions["two"] = test::robot(test::boxLink("c") + test::boxLink("d") +
                                            "<joint name='turn' type='continuous'><parent link='c'/>"
                                            "<child link='d'/></joint>");
  const Scene scene =
      load("defaults: {max_edge_length: 100}\nrobots:\n  - {description: one}\n  - {description: two}\n");
  EXPECT_TRUE(test::mentions(messageOf([&] { SceneKinematics joints(scene); }), "joint 'turn': robots"));
}

TEST_F(SceneKinematicsTest, ServesARobotWhoseJointsMakeNoSenseWithoutThem) {
  const Scene scene =
      loadRobotScene(test::robot(test::boxLink("a") + test::boxLink("b") +
                                 "<joint name='turn' type='continuous'><parent link='a'/><child link='b'/>"
                                 "<mimic joint='turn'/></joint>"),
                     "URDF", options);
  EXPECT_EQ(scene.bodies.size(), 2U);
  EXPECT_TRUE(scene.robots.empty());
  EXPECT_TRUE(test::hasNote(scene, "joint 'turn': the joints that it mimics lead back"));
}

}  // namespace
}  // namespace concave_distance::scene_kinematics_test
