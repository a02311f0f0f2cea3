#include <gtest/gtest.h>

#include "support/scene_fixture.h"

namespace concave_distance::simulation_section_test {
namespace {

using test::mentions;

const std::string kBodies =
    "bodies:\n"
    "  - {name: ball, sphere: {radius: 1}, max_edge_length: 100}\n"
    "  - {name: ground, box: {size: [1, 1, 1]}, max_edge_length: 100}\n";

class SimulationSection : public test::SceneTest {
 protected:
  SimulationSettings read(const std::string& section) const {
    return load(kBodies + "simulation:\n" + section).simulation.value();
  }
  void expectRefused(const std::string& section, const std::string& place, const std::string& seen,
                     const std::string& allowed) const {
    const std::string text = refusal(kBodies + "simulation:\n" + section);
    EXPECT_EQ(text.substr(0, place.size() + 2), place + ": ") << text;
    EXPECT_TRUE(mentions(text, seen)) << text;
    EXPECT_TRUE(mentions(text, allowed)) << text;
  }
};

TEST_F(SimulationSection, IsThereOnlyWhereTheFileHasIt) {
  EXPECT_FALSE(load(kBodies).simulation);
  EXPECT_TRUE(load(kBodies + "simulation: {}\n").simulation);
}

TEST_F(SimulationSection, EveryKeyIsRead) {
  folder.write("poses.csv", "t,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n2,4,5,6,0,0,1,0\n");
  const SimulationSettings s = read(
      "  gravity: [0, 0, -1.62]\n  duration: 3\n  largest_step: 0.01\n  step_fraction: 0.2\n"
      "  allowed_penetration: 1e-3\n  log_rate: 500\n  tracking: both\n  bodies:\n"
      "    - body: ball\n      pose: {xyz: [1, 2, 3]}\n      velocity: [4, 5, 6]\n"
      "      angular_velocity: [7, 8, 9]\n"
      "      inertia: {mass: 2, centre: [0.1, 0.2, 0.3], tensor: [2, 2.5, 3, 0.1, 0.2, 0.3]}\n"
      "      drive:\n        frame: {xyz: [0, 0, 1]}\n        stiffness: 100\n        damping: [1, 2, 3]\n"
      "        rotational_stiffness: [4, 5, 6]\n        rotational_damping: 7\n"
      "        target: {file: poses.csv, delay: 1, offset: {xyz: [0, 0, 10]}}\n"
      "      loads:\n        - {force: [1, 0, 0], torque: [0, 1, 0], point: [0, 0, 1], frame: body, from: 1, "
      "until: 2}\n"
      "    - body: ground\n      path: [{time: 0}, {time: 1, pose: {xyz: [0, 0, 1]}}]\n");
  EXPECT_EQ(s.gravity, Eigen::Vector3d(0, 0, -1.62));
  EXPECT_EQ(s.duration, 3.0);
  EXPECT_EQ(s.largest_step, 0.01);
  EXPECT_EQ(s.step_fraction, 0.2);
  EXPECT_EQ(s.allowed_penetration, 1e-3);
  EXPECT_EQ(s.log_rate, 500.0);
  EXPECT_EQ(s.tracking, SimulationTracking::Both);
  ASSERT_EQ(s.bodies.size(), 2U);
  const SimulatedBodySettings& ball = s.bodies[0];
  EXPECT_EQ(ball.motion, BodyMotion::Free);
  EXPECT_EQ(ball.pose.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(ball.velocity, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(ball.angular_velocity, Eigen::Vector3d(7, 8, 9));
  ASSERT_TRUE(ball.inertia);
  EXPECT_EQ(ball.inertia->mass, 2.0);
  EXPECT_EQ(ball.inertia->centre_in_body, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(ball.inertia->inertia(0, 2), 0.2);
  EXPECT_EQ(ball.inertia->inertia(2, 1), 0.3);
  ASSERT_TRUE(ball.drive);
  EXPECT_EQ(ball.drive->body_from_drive.translation(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(ball.drive->stiffness, Eigen::Vector3d(100, 100, 100));
  EXPECT_EQ(ball.drive->damping, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(ball.drive->rotational_stiffness, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(ball.drive->rotational_damping, Eigen::Vector3d(7, 7, 7));
  ASSERT_EQ(ball.drive->target.size(), 2U);
  EXPECT_EQ(ball.drive->target[1].time, 3.0);
  EXPECT_EQ(ball.drive->target[1].pose.translation(), Eigen::Vector3d(4, 5, 16));
  ASSERT_EQ(ball.loads.size(), 1U);
  EXPECT_EQ(ball.loads[0].force, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(ball.loads[0].torque, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(ball.loads[0].point_in_body, Eigen::Vector3d(0, 0, 1));
  EXPECT_TRUE(ball.loads[0].in_body_frame);
  EXPECT_EQ(ball.loads[0].from, 1.0);
  EXPECT_EQ(ball.loads[0].until, 2.0);
  EXPECT_EQ(s.bodies[1].motion, BodyMotion::Driven);
  ASSERT_EQ(s.bodies[1].path.size(), 2U);
  EXPECT_EQ(s.bodies[1].path[1].pose.translation(), Eigen::Vector3d(0, 0, 1));
}

TEST_F(SimulationSection, NumbersOutOfRangeAreRefusedWithPlaceValueAndRange) {
  for (const char* key : {"duration", "largest_step", "allowed_penetration", "work_tolerance",
                          "energy_tolerance", "log_rate"}) {
    expectRefused("  " + std::string(key) + ": 0\n", "scene.yaml:5, simulation." + std::string(key),
                  "the value is '0'", "greater than 0");
  }
  expectRefused("  step_fraction: 1.5\n", "scene.yaml:5, simulation.step_fraction", "'1.5'", "at most 1");
  expectRefused("  gravity: 9.81\n", "scene.yaml:5, simulation.gravity", "'9.81'", "three numbers");
  expectRefused("  tracking: one\n", "scene.yaml:5, simulation.tracking", "'one'",
                "niches, single_minimum, both");
  expectRefused("  gravitation: 1\n", "scene.yaml:5, simulation.gravitation", "not known", "gravity");
}

TEST_F(SimulationSection, WhatABodyCannotHaveTogetherIsRefused) {
  const std::string head = "  bodies:\n    - body: ball\n";
  const std::string place = "scene.yaml:7, simulation.bodies[0].";
  expectRefused(head + "      velocity: [0, 0, 1]\n      fixed: true\n", place + "velocity", "fixed",
                "leave it out");
  expectRefused(head + "      mass: 1\n      density: 1\n", "scene.yaml:6, simulation.bodies[0]",
                "more than one", "one of them");
  expectRefused(head + "      mass: -1\n", place + "mass", "'-1'", "greater than 0, kg");
  expectRefused(head + "      inertia: {mass: 1, tensor: [1, 1, 3, 0, 0, 0]}\n", place + "inertia",
                "principal moments", "sum of the others");
  expectRefused(head + "      drive: {target: [{time: 1}, {time: 1}]}\n", place + "drive.target[1].time",
                "'1'", "after the pose before");
  expectRefused(head + "      drive: {target: [{time: 0}], stiffness: [1, -1, 1]}\n",
                place + "drive.stiffness", "a list of 3", "from 0");
  expectRefused(head + "      loads: [{point: [0, 0, 0]}]\n", place + "loads[0]", "force", "one of them");
  expectRefused(head + "      path: {file: nowhere.csv}\n", place + "path.file, nowhere.csv", "nowhere.csv",
                "");
  expectRefused("  bodies: [{body: ball, mass: 1}, {body: ball, mass: 1}]\n",
                "scene.yaml:5, simulation.bodies[1]", "is given twice", "remove one");
}

TEST_F(SimulationSection, TheInertiaOfALinkComesInTheLinksAxes) {
  const Scene scene = loadRobot(test::robot(
      "<link name='a'><inertial><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><mass value='4'/>"
      "<inertia ixx='1' iyy='2' izz='2.5' ixy='0' ixz='0' iyz='0'/></inertial>"
      "<collision><geometry><box size='1 1 1'/></geometry></collision></link>"));
  ASSERT_EQ(scene.bodies.size(), 1U);
  ASSERT_TRUE(scene.bodies[0].inertia);
  EXPECT_EQ(scene.bodies[0].inertia->mass, 4.0);
  EXPECT_EQ(scene.bodies[0].inertia->centre_in_body, Eigen::Vector3d(1, 2, 3));
  // A quarter turn about z swaps the moments about x and y.
  EXPECT_LT(
      (scene.bodies[0].inertia->inertia - Eigen::Matrix3d(Eigen::Vector3d(2, 1, 2.5).asDiagonal())).norm(),
      1e-14);
}

}  // namespace
}  // namespace concave_distance::simulation_section_test
