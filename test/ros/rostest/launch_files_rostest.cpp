// Every launch file of the package, started with its defaults (no rviz), with a robot on the parameter server
// and without one, and where a simulation has left /use_sim_time behind.
#include <concave_distance/Distances.h>
#include <concave_distance/ListBodies.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/package.h>
#include <ros/param.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "launched_file.h"
#include "rostest_support.h"
#include "support/temporary_folder.h"
#include "tf_player.h"

namespace concave_distance::launch_files_rostest {
namespace {

constexpr double kStart = 60.0;  // s, for roslaunch and the nodes to start on a busy machine
const char* const kNode = "/concave_distance";

std::string robotText() {
  return test::contentOf(ros::package::getPath("concave_distance") + "/test/ros/rostest/two_links.urdf");
}

bool hasDistance(const Distances& message) {
  return std::any_of(message.pairs.begin(), message.pairs.end(),
                     [](const PairDistance& pair) { return pair.has_distance != 0; });
}

void expectDistances(LaunchedFile& launched) {
  Collector<Distances> distances(std::string(kNode) + "/distances");
  EXPECT_TRUE(distances.waitFor(hasDistance, kStart)) << launched.output();
  launched.expectAllUp();
  EXPECT_TRUE(launched.end());
  // A script may end only after the first distance.
  EXPECT_EQ(launched.output().find("ModuleNotFoundError"), std::string::npos) << launched.output();
}

// A file that switches the cutoff off.
std::string cutoffFile() {
  const std::string path = std::filesystem::temp_directory_path() / "launch_files_rostest_cutoff.yaml";
  std::ofstream(path) << "cutoff: none\n";
  return path;
}

void removeRobot() {
  ros::param::del("/robot_description");
}

// A simulation that has ended leaves this on the parameter server.
void leaveSimulatedTime() {
  ros::param::set("/use_sim_time", true);
}

TEST(LaunchFiles, TheNodeWithItsDefaultsServesTheRobot) {
  ros::param::set("/use_sim_time", false);
  ros::param::set("/robot_description", robotText());
  TfPlayer player;
  player.place("base", 0.0);
  player.place("tip", 1.2);  // nearer than the cutoff of a robot of that size
  LaunchedFile launched({"distance_node.launch"});
  expectDistances(launched);
  removeRobot();
}

TEST(LaunchFiles, TheNodeWithItsDefaultsWaitsForARobotAndThenServesIt) {
  ros::param::set("/use_sim_time", false);
  removeRobot();
  TfPlayer player;
  player.place("base", 0.0);
  player.place("tip", 1.2);  // nearer than the cutoff of a robot of that size
  LaunchedFile launched({"distance_node.launch"});
  const std::string service = std::string(kNode) + "/list_bodies";
  ASSERT_TRUE(ros::service::waitForService(service, ros::Duration(kStart))) << launched.output();
  std::string message;
  EXPECT_TRUE(eventually([&] {
    message = call<ListBodies>(service, {}).message;
    return message.find("there is no parameter 'robot_description'") != std::string::npos;
  })) << message;
  launched.expectAllUp();
  ros::param::set("/robot_description", robotText());
  expectDistances(launched);
  removeRobot();
}

class DemoLaunchFile : public testing::TestWithParam<const char*> {};

TEST_P(DemoLaunchFile, GivesDistancesWithoutARobotAndAfterASimulation) {
  removeRobot();
  leaveSimulatedTime();
  LaunchedFile launched({GetParam(), "rviz:=false"});
  expectDistances(launched);
}

TEST_P(DemoLaunchFile, GivesDistancesBesideAnotherRobot) {
  ros::param::set("/robot_description", robotText());
  leaveSimulatedTime();
  LaunchedFile launched({GetParam(), "rviz:=false"});
  expectDistances(launched);
  removeRobot();
}

TEST(LaunchFiles, OwnRobotServesWhatIsOnTheParameterServerAndOnTf) {
  ros::param::set("/use_sim_time", false);
  ros::param::set("/robot_description", robotText());
  TfPlayer player;
  player.place("base", 0.0);
  player.place("tip", 1.2);  // nearer than the cutoff of a robot of that size
  LaunchedFile launched({"own_robot.launch", "rviz:=false"});
  expectDistances(launched);
  removeRobot();
}

TEST(LaunchFiles, OwnRobotMovesARobotThatIsAFile) {
  removeRobot();
  leaveSimulatedTime();
  const std::string file = ros::package::getPath("concave_distance") + "/test/ros/rostest/own_robot.urdf";
  LaunchedFile launched({"own_robot.launch", "rviz:=false", "urdf:=" + file});
  expectDistances(launched);
  removeRobot();
}

TEST(LaunchFiles, OwnRobotHoldsFloatingJointsAtTheirOriginsUntilSomethingMovesThem) {
  removeRobot();
  ros::param::set("/use_sim_time", false);
  const std::string file =
      ros::package::getPath("concave_distance") + "/test/ros/rostest/floating_joints.urdf";
  LaunchedFile launched({"own_robot.launch", "rviz:=false", "urdf:=" + file, "config_file:=" + cutoffFile()});
  Collector<Distances> distances(std::string(kNode) + "/distances");
  const auto measures = [](double distance) {
    return [distance](const Distances& message) {
      return message.pairs.size() == 1 && message.pairs[0].has_distance != 0 &&
             std::abs(message.pairs[0].distance - distance) < 1e-9;
    };
  };
  EXPECT_TRUE(distances.waitFor(measures(3.0), kStart)) << launched.output();
  TfPlayer player;
  player.place("load", 7.0, 0.0, 1.0);
  EXPECT_TRUE(distances.waitFor(measures(6.0))) << "something moves it now";
  EXPECT_TRUE(launched.end());
  EXPECT_NE(launched.output().find("floating joint 'grip' stands at its origin"), std::string::npos)
      << launched.output();
  removeRobot();
}

class BridgeLaunchFile : public testing::TestWithParam<const char*> {};

TEST_P(BridgeLaunchFile, WaitsForWhatIsNotThereAndSaysSo) {
  removeRobot();
  ros::param::set("/use_sim_time", false);
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  LaunchedFile launched({std::string(GetParam()) + ".launch"});
  const auto says = [](const diagnostic_msgs::DiagnosticArray& message) {
    const auto& entry = message.status.at(0);
    return entry.name.find(GetParam()) != std::string::npos &&
           entry.level == diagnostic_msgs::DiagnosticStatus::WARN &&
           std::any_of(entry.values.begin(), entry.values.end(),
                       [](const auto& value) { return value.value.find("waiting") != std::string::npos; });
  };
  EXPECT_TRUE(diagnostics.waitFor(says, kStart)) << launched.output();
  launched.expectAllUp();
  EXPECT_TRUE(launched.end());
}

INSTANTIATE_TEST_SUITE_P(Bridges, BridgeLaunchFile, testing::Values("cob_bridge", "moveit_bridge"),
                         [](const auto& info) { return std::string(info.param); });

INSTANTIATE_TEST_SUITE_P(Demos, DemoLaunchFile,
                         testing::Values("insertion.launch", "contact.launch", "interactive.launch",
                                         "robot.launch", "cell.launch", "clouds.launch", "crowd.launch",
                                         "rows.launch", "simulation.launch"),
                         [](const auto& info) {
                           const std::string name = info.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace concave_distance::launch_files_rostest
