#include "concave_distance/kinematics/robot_kinematics.h"

#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <map>
#include <random>

#include "concave_distance/base/error.h"
#include "support/count_allocations.h"
#include "support/robots.h"
#include "support/scene_fixture.h"

namespace concave_distance::robot_kinematics_test {
namespace {

using Named = std::map<std::string, double>;

struct PlainPose {
  urdf::Vector3 position;
  urdf::Rotation rotation;
};

urdf::Rotation turned(double angle, const urdf::Vector3& axis) {
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  const double s = std::sin(0.5 * angle) / length;
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(0.5 * angle)};
}

PlainPose then(const PlainPose& first, const PlainPose& second) {
  urdf::Vector3 moved = first.rotation * second.position;
  return {moved + first.position, first.rotation * second.rotation};
}

urdf::Vector3 scaled(double factor, const urdf::Vector3& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

double valueOf(const urdf::ModelInterface& model, const urdf::Joint& joint, const Named& at) {
  if (!joint.mimic) return at.at(joint.name);
  const double followed = valueOf(model, *model.getJoint(joint.mimic->joint_name), at);
  return joint.mimic->multiplier * followed + joint.mimic->offset;
}

/// Forward kinematics in urdfdom's quaternions, by recursion from the link to the root.
PlainPose plainPose(const urdf::ModelInterface& model, const urdf::Link& link, const Named& at) {
  const urdf::JointSharedPtr joint = link.parent_joint;
  if (!joint) return {};
  PlainPose pose = plainPose(model, *model.getLink(joint->parent_link_name), at);
  const urdf::Pose& origin = joint->parent_to_joint_origin_transform;
  pose = then(pose, {origin.position, origin.rotation});
  const urdf::Vector3 axis = joint->axis;
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  switch (joint->type) {
    case urdf::Joint::FIXED:
      return pose;
    case urdf::Joint::PRISMATIC:
      return then(pose, {scaled(valueOf(model, *joint, at) / length, axis), {}});
    case urdf::Joint::FLOATING: {
      urdf::Rotation rotation(at.at("fly/rot_x"), at.at("fly/rot_y"), at.at("fly/rot_z"), at.at("fly/rot_w"));
      rotation.normalize();
      return then(pose, {{at.at("fly/trans_x"), at.at("fly/trans_y"), at.at("fly/trans_z")}, rotation});
    }
    case urdf::Joint::PLANAR: {
      // The shortest turn from z to the axis takes x and y along.
      const urdf::Vector3 across(-axis.y, axis.x, 0.0);
      const urdf::Rotation tilt = turned(std::acos(axis.z / length), across);
      urdf::Vector3 x = scaled(at.at("drive/x"), tilt * urdf::Vector3(1, 0, 0));
      const urdf::Vector3 y = scaled(at.at("drive/y"), tilt * urdf::Vector3(0, 1, 0));
      return then(pose, {x + y, turned(at.at("drive/theta"), axis)});
    }
    default:
      return then(pose, {{0, 0, 0}, turned(valueOf(model, *joint, at), axis)});
  }
}

struct Robot {
  std::string name;
  std::string urdf;
};
std::vector<Robot> robots() {
  return {{"kr5", test::packageFile("urdf/kr5.urdf")},
          {"wam", test::packageFile("urdf/wam.urdf")},
          {"mobile", test::mobileRobot()}};
}

TEST(RobotKinematics, PlacesLinksWhereUrdfdomsQuaternionsDo) {
  for (const Robot& given : robots()) {
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(given.urdf);
    const RobotKinematics robot(given.urdf);
    RobotState state = robot.restState();
    ASSERT_EQ(robot.linkNames().size(), model->links_.size());
    std::mt19937 engine(1);
    for (int trial = 0; trial < 1000; ++trial) {
      const Eigen::VectorXd positions = test::randomPositions(robot, engine);
      robot.evaluate(positions, Eigen::Isometry3d::Identity(), state);
      Named at;
      for (std::size_t i = 0; i < robot.positionNames().size(); ++i) {
        at[robot.positionNames()[i]] = positions[static_cast<Eigen::Index>(i)];
      }
      for (std::size_t link = 0; link < robot.linkNames().size(); ++link) {
        const PlainPose pose = plainPose(*model, *model->getLink(robot.linkNames()[link]), at);
        Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
        expected.translation() << pose.position.x, pose.position.y, pose.position.z;
        expected.linear() =
            Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
                .toRotationMatrix();
        ASSERT_LT((state.world_from_link[link].matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-13)
            << given.name << " " << robot.linkNames()[link];
      }
    }
  }
}

TEST(RobotKinematics, JacobiansAreTheDifferencesOfPositions) {
  constexpr double kStep = 1e-5;
  for (const Robot& given : robots()) {
    const RobotKinematics robot(given.urdf);
    const auto count = static_cast<Eigen::Index>(robot.velocityNames().size());
    RobotState state = robot.restState();
    RobotState ahead = state;
    RobotState behind = state;
    std::mt19937 engine(2);
    Eigen::Matrix3Xd columns(3, count);
    for (int trial = 0; trial < 300; ++trial) {
      const Eigen::VectorXd positions = test::randomPositions(robot, engine);
      const Eigen::Isometry3d root(Eigen::Translation3d(1.0, 2.0, 3.0) *
                                   Eigen::AngleAxisd(0.1 * trial, Eigen::Vector3d(1, 2, 3).normalized()));
      robot.evaluate(positions, root, state);
      const std::size_t link = static_cast<std::size_t>(trial) % robot.linkNames().size();
      const Eigen::Vector3d point_in_link(0.1, -0.2, 0.3);
      robot.jacobian(state, link, state.world_from_link[link] * point_in_link, columns);
      for (Eigen::Index i = 0; i < count; ++i) {
        robot.evaluate(test::stepped(robot, positions, static_cast<std::size_t>(i), kStep), root, ahead);
        robot.evaluate(test::stepped(robot, positions, static_cast<std::size_t>(i), -kStep), root, behind);
        const Eigen::Vector3d difference =
            (ahead.world_from_link[link] * point_in_link - behind.world_from_link[link] * point_in_link) /
            (2.0 * kStep);
        ASSERT_LT((columns.col(i) - difference).norm(), 1e-9)
            << given.name << " " << robot.linkNames()[link] << " " << robot.velocityNames()[i];
      }
    }
  }
}

TEST(RobotKinematics, TakesTheSameStateFromPosesAsFromPositions) {
  const RobotKinematics robot(test::mobileRobot());
  RobotState state = robot.restState();
  std::mt19937 engine(3);
  robot.evaluate(test::randomPositions(robot, engine), Eigen::Isometry3d(Eigen::Translation3d(5, 6, 7)),
                 state);
  RobotState taken = robot.restState();
  std::size_t count = 0;
  for (std::size_t link = 0; link < robot.linkNames().size(); ++link) {
    if (!robot.isTaken(link)) continue;
    taken.world_from_link[link] = state.world_from_link[link];
    ++count;
  }
  EXPECT_EQ(count, robot.linkNames().size() - 1U) << "all but the wrist";
  robot.takeLinks(taken);
  for (std::size_t link = 0; link < robot.linkNames().size(); ++link) {
    EXPECT_TRUE(taken.world_from_link[link].isApprox(state.world_from_link[link], 1e-15));
  }
  ASSERT_EQ(taken.axes.size(), state.axes.size());
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    EXPECT_EQ(taken.axes[i].direction, state.axes[i].direction);
    EXPECT_EQ(taken.axes[i].turns, state.axes[i].turns);
  }
}

TEST(RobotKinematics, OrdersPositionsAsTheUrdfDoesWithThePrefixBeforeEachName) {
  const RobotKinematics robot(test::mobileRobot(), "URDF", "/r1/");
  const std::vector<std::string> positions{
      "r1/grip",      "r1/drive/x",   "r1/drive/y",     "r1/drive/theta", "r1/raise",
      "r1/swing",     "r1/roll",      "r1/fly/trans_x", "r1/fly/trans_y", "r1/fly/trans_z",
      "r1/fly/rot_x", "r1/fly/rot_y", "r1/fly/rot_z",   "r1/fly/rot_w"};
  EXPECT_EQ(robot.positionNames(), positions);
  EXPECT_EQ(robot.velocityNames(), std::vector<std::string>(positions.begin(), positions.end() - 1));
  EXPECT_EQ(robot.linkNames().front(), "r1/hall");
  EXPECT_EQ(robot.name(), "r1/mobile");
  EXPECT_FALSE(robot.isMoved(0));
  EXPECT_TRUE(robot.isMoved(robot.findLink("r1/wrist").value()));
  EXPECT_FALSE(robot.findLink("wrist").has_value());
  EXPECT_EQ(robot.restPositions()[13], 1.0);
}

TEST(RobotKinematics, AllocatesNothingWhereItEvaluates) {
  const RobotKinematics robot(test::mobileRobot());
  RobotState state = robot.restState();
  const Eigen::VectorXd positions = robot.restPositions();
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(robot.velocityNames().size()));
  const std::size_t before = allocations;
  for (int i = 0; i < 10; ++i) {
    robot.evaluate(positions, Eigen::Isometry3d::Identity(), state);
    robot.jacobian(state, 5, Eigen::Vector3d::Ones(), columns);
    robot.takeLinks(state);
  }
  EXPECT_EQ(allocations, before);
}

template <typename Act>
std::string refusalOf(const Act& act) {
  try {
    act();
    return "accepted";
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
}

std::string refusalOfJoints(const std::string& joints) {
  const std::string links = test::bareLink("a") + test::bareLink("b") + test::bareLink("c");
  return refusalOf([&] { RobotKinematics(test::robot(links + joints), "arm.urdf"); });
}

TEST(RobotKinematics, RefusesJointsThatCannotBeMoved) {
  using test::movingJoint;
  const std::string first = movingJoint("j", "revolute", "a", "b");
  EXPECT_EQ(refusalOfJoints(first + movingJoint("k", "revolute", "b", "c")), "accepted");
  const auto mimics = [&](const std::string& type, const std::string& joint) {
    return movingJoint("k", type, "b", "c", "<mimic joint='" + joint + "'/>");
  };
  const auto expect = [&](const std::string& joints, const std::string& joint, const std::string& what) {
    const std::string refusal = refusalOfJoints(joints);
    EXPECT_TRUE(test::mentions(refusal, "arm.urdf")) << refusal;
    EXPECT_TRUE(test::mentions(refusal, joint)) << refusal;
    EXPECT_TRUE(test::mentions(refusal, what)) << refusal;
  };
  expect(first + mimics("revolute", "k"), "joint 'k'", "lead back to themselves");
  expect(movingJoint("j", "revolute", "a", "b", "<mimic joint='k'/>") + mimics("prismatic", "j"), "joint 'j'",
         "lead back");
  expect(first + mimics("revolute", "x"), "joint 'k'", "'x', which is no joint");
  expect(first + mimics("floating", "j"), "joint 'k'", "more than one position");
  expect(movingJoint("j", "floating", "a", "b") + mimics("revolute", "j"), "joint 'k'", "no single position");
  expect(movingJoint("j", "fixed", "a", "b") + mimics("revolute", "j"), "joint 'k'", "no single position");
  expect(first + movingJoint("k", "revolute", "b", "c", "<axis xyz='0 0 0'/>"), "joint 'k'", "no direction");
  expect(first + movingJoint("k", "spherical", "b", "c"), "urdfdom says", "no known type");
}

TEST(RobotKinematics, RefusesPositionsThatAreNotOneForEachJoint) {
  const RobotKinematics robot(test::mobileRobot());
  const std::vector<std::string> names = robot.positionNames();
  const Eigen::VectorXd rest = robot.restPositions();
  const std::vector<double> values(rest.data(), rest.data() + rest.size());
  EXPECT_EQ(robot.positionsOf(names, values), rest);
  const auto refusal = [&](const std::string& name, double value) {
    auto more_names = names;
    auto more_values = values;
    more_names.push_back(name);
    more_values.push_back(value);
    return refusalOf([&] { robot.positionsOf(more_names, more_values); });
  };
  using test::mentions;
  EXPECT_EQ(refusal("grip2", 0.01), "accepted") << "where it follows grip";
  EXPECT_TRUE(
      mentions(refusal("grip2", 0.02), "'grip2': its position is 0.02, but what it mimics puts it at 0.01"));
  EXPECT_TRUE(mentions(refusal("grop", 0.0), "'grop': robot 'mobile' has no such joint"));
  EXPECT_TRUE(mentions(refusal("grip", 0.0), "'grip': it is given twice"));
  EXPECT_TRUE(mentions(refusal("bolt", 0.0), "'bolt': it is fixed"));
  EXPECT_TRUE(mentions(refusal("fly", 0.0), "'fly': it has 7 positions (name them 'fly/trans_x'"));
  EXPECT_TRUE(mentions(refusal("grip3", std::nan("")), "'grip3': its position is not finite"));
  const std::vector<std::string> fewer(names.begin(), names.end() - 1);
  EXPECT_TRUE(mentions(refusalOf([&] { robot.positionsOf(fewer, values); }), "13 names and 14 positions"));
  EXPECT_TRUE(mentions(
      refusalOf([&] { robot.positionsOf(fewer, std::vector<double>(values.begin(), values.end() - 1)); }),
      "fly/rot_w missing"));
  RobotState state = robot.restState();
  const auto evaluate = [&](const Eigen::VectorXd& at) {
    return refusalOf([&] { robot.evaluate(at, Eigen::Isometry3d::Identity(), state); });
  };
  Eigen::VectorXd wrong = rest;
  wrong[4] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(mentions(evaluate(wrong), "joint 'raise': its position is not finite"));
  EXPECT_TRUE(mentions(evaluate(Eigen::VectorXd::Zero(3)), "3 joint positions (give 14"));
  EXPECT_TRUE(mentions(evaluate(Eigen::VectorXd::Zero(14)), "its quaternion is zero"));
}

}  // namespace
}  // namespace concave_distance::robot_kinematics_test
