#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cstdlib>
#include <exception>

#include "base/memory_arenas.h"
#include "scene_loader.h"
#include "simulation_runner.h"

namespace {

using namespace concave_distance;

void run() {
  const ros::NodeHandle node;
  const ros::NodeHandle private_node("~");
  XmlRpc::XmlRpcValue values;
  private_node.getParam("", values);
  const SimulationNodeParameters parameters = parseSimulationParameters(values);
  NodeParameters loading;
  loading.scene_file = parameters.scene_file;
  loading.robot_description = parameters.robot_description;
  SceneRequest request = requestScene(loading, node);
  for (; !request.waiting_for.empty() && ros::ok(); request = requestScene(loading, node)) {
    ROS_INFO_STREAM_THROTTLE(5.0, "waiting: " << request.waiting_for);
    ros::WallDuration(0.2).sleep();
  }
  if (!ros::ok()) return;
  LoadProgress progress;
  Scene scene = loadScene(loading, request, progress);
  const SimulationRunner runner(node, private_node, std::move(scene), parameters);
  ros::spin();
}

}  // namespace

int main(int argc, char** argv) {
  concave_distance::limitMemoryArenas();
  ros::init(argc, argv, "simulation");
  try {
    run();
  } catch (const std::exception& problem) {
    ROS_FATAL_STREAM(problem.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
