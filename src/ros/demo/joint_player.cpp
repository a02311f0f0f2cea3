/// Publishes joint states along a closed path of joint positions: the robot demo.
///
/// Private parameters: `path` (resource of a `t,<joint>,...` file), `rate` (Hz, 100), `speed` (1), `start`
/// (seconds into the path, 0).

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include "demo_parameters.h"
#include "joint_path.h"

namespace {

using namespace concave_distance;

void run() {
  const ros::NodeHandle node("~");
  const demo::NamedJointPath joints = demo::readJointPath(demo::fileParameter(node, "path"));
  const double rate = demo::numberParameter(node, "rate", 100.0, 0.1, 2000.0);
  const double speed = demo::numberParameter(node, "speed", 1.0, 0.0, 100.0);
  const double start = demo::numberParameter(node, "start", 0.0, 0.0, 3600.0);

  ros::NodeHandle public_node;
  ros::Publisher publisher = public_node.advertise<sensor_msgs::JointState>("joint_states", 1);
  sensor_msgs::JointState message;
  message.name = joints.joints;
  demo::playAtRate(rate, [&](double time, const ros::Time& now) {
    const Eigen::VectorXd positions = joints.path.at(start + speed * time);
    message.header.stamp = now;
    message.position.assign(positions.data(), positions.data() + positions.size());
    publisher.publish(message);
  });
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::demo::runNode(argc, argv, "joint_player", run);
}
