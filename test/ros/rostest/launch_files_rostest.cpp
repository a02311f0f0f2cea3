// Every launch file of the package, started with its defaults (no rviz), with a robot on the parameter server
// and without one, and where a simulation has left /use_sim_time behind.
#include <concave_distance/Distances.h>
#include <concave_distance/ListBodies.h>
#include <gtest/gtest.h>
#include <ros/init.h>
#include <ros/package.h>
#include <ros/param.h>
#include <ros/spinner.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "launched_file.h"
#include "rostest_support.h"
#include "tf_player.h"

namespace concave_distance {
namespace {

constexpr double kStart = 60.0;  // s, for roslaunch and the nodes to start on a busy machine
const char* const kNode = "/concave_distance";

std::string robotText() {
  std::ifstream stream(ros::package::getPath("concave_distance") + "/test/ros/rostest/two_links.urdf");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
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
}

void removeRobot() {
  ros::param::del("/robot_description");
}

// What a simulation that has ended leaves on the parameter server.
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

INSTANTIATE_TEST_SUITE_P(Demos, DemoLaunchFile,
                         testing::Values("insertion.launch", "contact.launch", "interactive.launch",
                                         "robot.launch", "cell.launch", "simulation.launch"),
                         [](const auto& info) {
                           const std::string name = info.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "launch_files_rostest");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
