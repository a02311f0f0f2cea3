/// Publishes joint states along a closed path of joint positions: the robot demo.
///
/// Private parameters: `path` (resource of a `t,<joint>,...` file), `rate` (Hz, 100), `speed` (1), `start`
/// (seconds into the path, 0).

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include "demo_parameters.h"
#include "joint_path.h"
#include "ros/time_difference.h"
#include "run_node.h"

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
  ros::Time first;
  const ros::Timer timer = public_node.createTimer(ros::Duration(1.0 / rate), [&](const ros::TimerEvent&) {
    const ros::Time now = ros::Time::now();
    if (first.isZero() || now < first) first = now;
    const Eigen::VectorXd positions = joints.path.at(start + speed * secondsBetween(first, now));
    message.header.stamp = now;
    message.position.assign(positions.data(), positions.data() + positions.size());
    publisher.publish(message);
  });
  ros::spin();
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::demo::runNode(argc, argv, "joint_player", run);
}
