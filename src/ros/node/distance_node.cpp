#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cstdlib>
#include <exception>

#include "base/memory_arenas.h"
#include "concave_distance/base/error.h"
#include "distance_server.h"

namespace {

constexpr int kThreads = 2;  // loading the scene does not hold up subscribers and diagnostics

}  // namespace

int main(int argc, char** argv) {
  concave_distance::limitMemoryArenas();
  ros::init(argc, argv, "concave_distance");
  const ros::NodeHandle node;
  const ros::NodeHandle private_node("~");
  int exit_code = EXIT_SUCCESS;
  try {
    concave_distance::DistanceServer server(node, private_node, ros::this_node::getName(),
                                            [&exit_code](const concave_distance::Error& problem) {
                                              ROS_FATAL_STREAM(problem.what());
                                              exit_code = EXIT_FAILURE;
                                              ros::requestShutdown();
                                            });
    ros::AsyncSpinner spinner(kThreads);
    spinner.start();
    ros::waitForShutdown();
  } catch (const std::exception& problem) {
    ROS_FATAL_STREAM(problem.what());
    exit_code = EXIT_FAILURE;
  }
  return exit_code;
}
