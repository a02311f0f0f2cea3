// Starting up: before tf and the robot description, with meshes, URDFs, scene files and parameters that are
// wrong.
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <gtest/gtest.h>
#include <ros/init.h>
#include <ros/package.h>
#include <ros/param.h>
#include <ros/spinner.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "rostest_support.h"
#include "tf_player.h"

namespace concave_distance {
namespace {

ListBodiesResponse list(const std::string& node) {
  return call<ListBodies>(node + "/list_bodies", {});
}

bool isReady(const std::string& node) {
  return eventually([&] { return list(node).ready != 0; });
}

std::string readText(const std::string& name) {
  std::ifstream stream(ros::package::getPath("concave_distance") + "/test/ros/rostest/" + name);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(StartUp, WaitsForTheRobotDescriptionAndThenForTransforms) {
  const std::string node = "/waiting";
  EXPECT_TRUE(eventually([&] { return list(node).message.find("late_description") != std::string::npos; }))
      << "it says what it waits for: " << list(node).message;
  EXPECT_FALSE(list(node).ready);
  GetDistanceRequest request;
  request.query.body_a = "base";
  request.query.body_b = "tip";
  const auto early = call<GetDistance>(node + "/get_distance", request);
  EXPECT_FALSE(early.success);
  EXPECT_NE(early.message.find("not loaded yet"), std::string::npos) << early.message;

  ros::param::set("/late_description", readText("two_links.urdf"));
  ASSERT_TRUE(isReady(node));
  EXPECT_EQ(list(node).bodies.size(), 2U);

  Collector<Distances> distances(node + "/distances");
  ASSERT_TRUE(distances.waitFor([](const Distances& message) {
    return message.pairs.size() == 1 && message.pairs[0].status.code == PairStatus::MISSING_TRANSFORM;
  }));
  EXPECT_FALSE(distances.last()->pairs[0].status.message.empty());
  TfPlayer player;
  player.place("base", 0.0);
  player.place("tip", 3.0);
  EXPECT_TRUE(distances.waitFor([](const Distances& message) { return message.pairs[0].has_distance != 0; }));
  EXPECT_NEAR(distances.last()->pairs[0].distance, 2.0, 1e-12);
}

TEST(StartUp, MeshesThatCannotBeReadAreProblemsAndTheRestIsServed) {
  const std::string node = "/broken_meshes";
  ASSERT_TRUE(isReady(node));
  const ListBodiesResponse scene = list(node);
  for (const char* name : {"missing", "empty", "no_triangles", "truncated", "not_a_number", "no_area"}) {
    EXPECT_TRUE(std::any_of(scene.problems.begin(), scene.problems.end(),
                            [&](const Problem& problem) {
                              return (problem.where + problem.message).find(name) != std::string::npos;
                            }))
        << name << " is told as a problem";
    EXPECT_TRUE(std::none_of(scene.bodies.begin(), scene.bodies.end(),
                             [&](const BodyInfo& body) { return body.name == name; }));
  }
  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  request.query.use_pose_a = request.query.use_pose_b = 1;
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  request.query.pose_b.pose.position.y = 1.5;
  const auto response = call<GetDistance>(node + "/get_distance", request);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.result.nearest.distance, 0.5, 1e-12);
}

TEST(StartUp, InvalidUrdfsAreProblemsAndTheNodeLives) {
  for (const char* node : {"/invalid_urdf", "/invalid_mesh_urdf"}) {
    ASSERT_TRUE(isReady(node)) << node;
    const ListBodiesResponse scene = list(node);
    ASSERT_FALSE(scene.problems.empty()) << node;
    EXPECT_FALSE(scene.problems[0].message.empty());
    EXPECT_TRUE(scene.bodies.empty());
    GetDistanceRequest request;
    request.query.body_a = "base_link";
    request.query.body_b = "other";
    EXPECT_FALSE(call<GetDistance>(std::string(node) + "/get_distance", request).success);
  }
}

struct Ended {
  int exit_code;
  std::string output;
};

// Runs a node of its own until it ends; what it says on both streams.
Ended runNode(const std::string& arguments) {
  // It stands beside this program.
  const std::string node = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "distance_node";
  const std::string command = "timeout 20 " + node + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Ended ended{-1, ""};
  std::array<char, 256> buffer{};
  while (pipe != nullptr && fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    ended.output += buffer.data();
  }
  const int status = pipe == nullptr ? -1 : pclose(pipe);
  ended.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

TEST(StartUp, AWrongSceneFileEndsTheNodeWithFileAndLine) {
  const Ended ended = runNode("__name:=wrong_scene _robot_description:='' _scene_file:=" +
                              ros::package::getPath("concave_distance") + "/test/ros/rostest/broken.yaml");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("broken.yaml:3"), std::string::npos) << ended.output;
  EXPECT_NE(ended.output.find("bocks"), std::string::npos) << ended.output;
}

TEST(StartUp, AMissingSceneFileEndsTheNode) {
  const Ended ended = runNode("__name:=no_scene _scene_file:=/nowhere/scene.yaml");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("/nowhere/scene.yaml"), std::string::npos) << ended.output;
}

TEST(StartUp, AWrongParameterEndsTheNodeWithNameValueAndRange) {
  const Ended ended = runNode("__name:=wrong_parameter _rate:=-5.0");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("~rate"), std::string::npos) << ended.output;
  EXPECT_NE(ended.output.find("0.1 to 2000"), std::string::npos) << ended.output;
}

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "startup_rostest");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
