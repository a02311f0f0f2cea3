/// Plays a poses.csv on tf, forwards and backwards without end: the insertion demo.
///
/// Private parameters: `poses` (resource), `parent` and `child` (frames), `rate` (Hz, 200), `speed` (1),
/// `pause` (seconds of rest at either end, 1), `start` (seconds into the path, 0).

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include "demo_parameters.h"
#include "joint_path.h"
#include "loading/query_poses.h"
#include "simulation/pose_path.h"

namespace {

using namespace concave_distance;

void run() {
  const ros::NodeHandle node("~");
  const PosePath path(readPosePath(demo::fileParameter(node, "poses")));
  const std::string parent = demo::requireParameter(node, "parent");
  const std::string child = demo::requireParameter(node, "child");
  const double rate = demo::numberParameter(node, "rate", 200.0, 0.1, 2000.0);
  const double speed = demo::numberParameter(node, "speed", 1.0, 0.0, 100.0);
  const double pause = demo::numberParameter(node, "pause", 1.0, 0.0, 3600.0);
  const double start = demo::numberParameter(node, "start", 0.0, 0.0, 3600.0);

  tf2_ros::TransformBroadcaster broadcaster;
  demo::playAtRate(rate, [&](double time, const ros::Time& now) {
    const double duration = path.endTime() - path.startTime();
    const double on_path = path.startTime() + demo::pingPong(start + speed * time, duration, pause);
    broadcaster.sendTransform(demo::toTransform(path.poseAt(on_path), now, parent, child));
  });
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::demo::runNode(argc, argv, "pose_player", run);
}
