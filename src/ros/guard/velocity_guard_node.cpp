#include <ros/init.h>
#include <ros/node_handle.h>

#include <cstdlib>
#include <exception>

#include "base/memory_arenas.h"
#include "guard_server.h"

int main(int argc, char** argv) {
  concave_distance::limitMemoryArenas();
  ros::init(argc, argv, "velocity_guard");
  // They outlive the server: with the last handle ROS ends, and the message with it.
  const ros::NodeHandle node;
  const ros::NodeHandle private_node("~");
  try {
    const concave_distance::GuardServer server(node, private_node);
    ros::spin();
  } catch (const std::exception& problem) {
    ROS_FATAL_STREAM(problem.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
