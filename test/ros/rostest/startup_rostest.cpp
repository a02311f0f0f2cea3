// Starting up: before tf and the robot description, with meshes, URDFs, scene files and parameters that are
// wrong.
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/package.h>
#include <ros/param.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "rostest_support.h"
#include "run_node.h"
#include "started_node.h"
#include "support/temporary_folder.h"
#include "tf_player.h"

namespace concave_distance::startup_rostest {
namespace {

ListBodiesResponse list(const std::string& node) {
  return call<ListBodies>(node + "/list_bodies", {});
}

bool isReady(const std::string& node) {
  ListBodies service;
  // Asked again where roscpp has lost an answer (doc/services.md).
  return eventually(
      [&] { return ros::service::call(node + "/list_bodies", service) && service.response.ready != 0; });
}

std::string readText(const std::string& name) {
  return test::contentOf(ros::package::getPath("concave_distance") + "/test/ros/rostest/" + name);
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
  const auto solved =
      distances.match([](const Distances& message) { return message.pairs[0].has_distance != 0; });
  ASSERT_TRUE(solved);
  EXPECT_NEAR(solved->pairs[0].distance, 2.0, 1e-12);
}

// Where a problem is and what it says, in one text.
std::string told(const Problem& problem) {
  return problem.where + ": " + problem.message;
}

// A problem that says every part: the file, what is wrong with it and what can be done.
void expectProblem(const ListBodiesResponse& scene, const std::vector<std::string>& parts) {
  EXPECT_TRUE(std::any_of(scene.problems.begin(), scene.problems.end(),
                          [&](const Problem& problem) {
                            return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
                              return told(problem).find(part) != std::string::npos;
                            });
                          }))
      << "no problem says all of: " << ::testing::PrintToString(parts);
}

GetDistanceRequest boxesAtPoses() {
  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  request.query.use_pose_a = request.query.use_pose_b = 1;
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  request.query.pose_b.pose.position.y = 1.5;
  return request;
}

// The pair of boxes, from a service and on a topic.
void expectTheBoxesServed(const std::string& node) {
  const auto response = call<GetDistance>(node + "/get_distance", boxesAtPoses());
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.result.nearest.distance, 0.5, 1e-12);
  TfPlayer player;
  player.place("box_a", 0.0);
  player.place("box_b", 0.0, 1.25);
  Collector<Distances> distances(node + "/distances");
  EXPECT_TRUE(distances.waitFor([](const Distances& message) {
    return std::any_of(message.pairs.begin(), message.pairs.end(), [](const PairDistance& pair) {
      return pair.body_a == "box_a" && pair.body_b == "box_b" && std::abs(pair.distance - 0.25) < 1e-12;
    });
  })) << node;
}

TEST(StartUp, MeshesThatCannotBeReadAreProblemsAndTheRestIsServed) {
  const std::string node = "/broken_meshes";
  ASSERT_TRUE(isReady(node));
  const ListBodiesResponse scene = list(node);
  const std::string again = "export";  // the remedy
  expectProblem(scene, {"body 'missing'", "meshes/missing.stl' does not exist", "check the path"});
  expectProblem(scene, {"body 'empty'", "meshes/empty.stl", "the file is empty", again});
  expectProblem(scene, {"body 'no_triangles'", "meshes/no_triangles.stl", "no triangle", "mesh"});
  expectProblem(scene, {"body 'truncated'", "meshes/truncated.stl", "breaks off", again});
  expectProblem(scene, {"body 'not_a_number'", "meshes/nan.obj", "not finite", again});
  expectProblem(scene, {"body 'no_area'", "meshes/no_area.obj", "area"});
  EXPECT_EQ(scene.problems.size(), 6U);
  ASSERT_EQ(scene.bodies.size(), 2U);
  expectTheBoxesServed(node);
}

TEST(StartUp, RobotsThatCannotBeReadAreProblemsAndTheRestIsServed) {
  const std::string node = "/broken_robots";
  const std::string folder = "data/invalid";
  ASSERT_TRUE(isReady(node));
  const ListBodiesResponse scene = list(node);
  expectProblem(scene, {folder + "/invalid.urdf", "the URDF cannot be read", "no link of this robot"});
  expectProblem(scene, {folder + "/invalid_mesh.urdf, link 'base_link'", folder + "/invalid_mesh.stl",
                        "box_a/invalid_mesh_base_link"});
  expectProblem(scene, {folder + "/missing_mesh.urdf, link 'base_link'",
                        "this_file_does_not_exist.stl' does not exist", "check the path"});
  expectProblem(scene, {folder + "/missing_package.urdf, link 'base_link'", "package 'missing_package'",
                        "ROS_PACKAGE_PATH"});
  EXPECT_EQ(scene.problems.size(), 4U);
  EXPECT_EQ(scene.bodies.size(), 2U);
  expectTheBoxesServed(node);
}

TEST(StartUp, AnInvalidRobotDescriptionIsAProblemAndTheNodeLives) {
  for (const auto& [node, part] : {std::pair("/invalid_urdf", "the URDF cannot be read"),
                                   std::pair("/invalid_mesh_urdf", "invalid_mesh.stl")}) {
    ASSERT_TRUE(isReady(node)) << node;
    const ListBodiesResponse scene = list(node);
    EXPECT_EQ(scene.problems.size(), 1U);
    expectProblem(scene, {"invalid_", part});
    EXPECT_TRUE(scene.bodies.empty());
    GetDistanceRequest request;
    request.query.body_a = "base_link";
    request.query.body_b = "other";
    const auto response = call<GetDistance>(std::string(node) + "/get_distance", request);
    EXPECT_FALSE(response.success);
    EXPECT_NE(response.message.find("base_link"), std::string::npos) << response.message;
  }
}

TEST(StartUp, GeometryIsTheCollisionOrTheVisualOne) {
  TfPlayer player;
  player.place("base", 0.0);
  player.place("tip", 3.0);
  for (const auto& [node, gap] :
       {std::pair("/collision_geometry", 2.0), std::pair("/visual_geometry", 2.5)}) {
    Collector<Distances> distances(std::string(node) + "/distances");
    const auto solved = distances.match([](const Distances& message) {
      return message.pairs.size() == 1 && message.pairs[0].has_distance != 0;
    });
    ASSERT_TRUE(solved) << node;
    EXPECT_NEAR(solved->pairs[0].distance, gap, 1e-12) << node;
  }
}

// A bumpy square of 2 size^2 triangles, as binary STL.
void writeBumps(const std::string& path, int size) {
  std::ofstream file(path, std::ios::binary);
  const std::string header(80, ' ');
  const auto count = static_cast<std::uint32_t>(2 * size * size);
  file.write(header.data(), 80);
  file.write(reinterpret_cast<const char*>(&count), 4);
  const auto corner = [&](int i, int j) {
    const auto x = static_cast<float>(i) / static_cast<float>(size);
    const auto y = static_cast<float>(j) / static_cast<float>(size);
    const std::array<float, 3> point{x, y, 0.02F * std::sin(40.0F * x) * std::cos(30.0F * y)};
    file.write(reinterpret_cast<const char*>(point.data()), 12);
  };
  const std::array<char, 12> normal{};
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      for (const bool upper : {false, true}) {
        file.write(normal.data(), 12);
        corner(i, j);
        corner(i + 1, upper ? j + 1 : j);
        corner(upper ? i : i + 1, j + 1);
        file.write(normal.data(), 2);
      }
    }
  }
}

dynamic_reconfigure::Config setCutoff(const std::string& node, const std::string& cutoff) {
  dynamic_reconfigure::ReconfigureRequest request;
  request.config.strs.resize(1);
  request.config.strs[0].name = "cutoff";
  request.config.strs[0].value = cutoff;
  return call<dynamic_reconfigure::Reconfigure>(node + "/set_parameters", request).config;
}

// The parameter server keeps what dynamic_reconfigure was told, as texts.
TEST(StartUp, WhatWasReconfiguredIsReadAtTheNextStart) {
  const std::string node = "/restarted";
  const auto cutoff_of_next_start = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"__name:=restarted", "_robot_description:=both_geometries"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    StartedNode started(arguments);
    EXPECT_TRUE(isReady(node));
    const ListBodiesResponse scene = list(node);
    const double cutoff = scene.pairs.empty() ? -1.0 : scene.pairs.front().cutoff;
    setCutoff(node, "0.5");
    started.interrupt();
    EXPECT_EQ(started.waitForEnd(20.0), 0);
    return cutoff;
  };
  EXPECT_EQ(cutoff_of_next_start({"_cutoff:=0.25", "_time_budget:=0.125"}), 0.25) << "a number of YAML";
  EXPECT_EQ(cutoff_of_next_start({}), 0.5);
  std::string budget;
  EXPECT_TRUE(ros::param::get(node + "/time_budget", budget));
  EXPECT_EQ(budget, "0.125");
}

// A cutoff that suits this robot is nobody's setting, also when the reconfigure server has written all
// values.
TEST(StartUp, TheAutomaticCutoffDoesNotStayOnTheParameterServer) {
  const StartedNode started({"__name:=automatic", "_robot_description:=both_geometries"});
  ASSERT_TRUE(isReady("/automatic"));
  dynamic_reconfigure::ReconfigureRequest request;
  request.config.doubles.resize(1);
  request.config.doubles[0].name = "rate";
  request.config.doubles[0].value = 12.5;
  call<dynamic_reconfigure::Reconfigure>("/automatic/set_parameters", request);
  double rate = 0.0;
  EXPECT_TRUE(ros::param::get("/automatic/rate", rate));
  EXPECT_EQ(rate, 12.5);
  EXPECT_TRUE(eventually([] { return !ros::param::has("/automatic/cutoff"); }));
}

TEST(StartUp, PreparationIsReportedWhileServicesAnswer) {
  const std::string node = "/preparing";
  ASSERT_TRUE(eventually([&] { return list(node).message.find("large_description") != std::string::npos; }));
  const test::TemporaryFolder folder;
  std::string urdf = "<robot name='large'>";
  for (int link = 0; link < 4; ++link) {
    const std::string name = "large_" + std::to_string(link);
    writeBumps(folder.path(name + ".stl"), 150 + link);
    urdf += "<link name='" + name + "'><collision><geometry><mesh filename='file://" +
            folder.path(name + ".stl") + "'/></geometry></collision></link>";
    if (link > 0) {
      urdf += "<joint name='j" + std::to_string(link) + "' type='continuous'><parent link='large_" +
              std::to_string(link - 1) + "'/><child link='" + name + "'/></joint>";
    }
  }
  ros::param::set("/large_description", urdf + "</robot>");
  bool reported = false;
  EXPECT_TRUE(eventually(
      [&] {
        const ListBodiesResponse scene = list(node);
        if (!reported && scene.message.find("loading: prepared") != std::string::npos) {
          reported = true;
          setCutoff(node, "0.123");
        }
        return scene.ready != 0;
      },
      60.0))
      << list(node).message;
  EXPECT_TRUE(reported);
  EXPECT_EQ(list(node).bodies.size(), 4U);
  ASSERT_EQ(list(node).pairs.size(), 3U);
  for (const PairInfo& pair : list(node).pairs) {
    EXPECT_EQ(pair.cutoff, 0.123) << "set while the scene was loading";
  }
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
}  // namespace concave_distance::startup_rostest
