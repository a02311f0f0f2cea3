/// Moves a robot without a driver: publishes its joint states and the transform from `root_frame` to its root
/// link, for robot_state_publisher and the distance node. A floating joint, which joint states do not have,
/// stands at its origin: its transform is on /tf_static until something publishes it on /tf.
///
/// Private parameters: `robot_description` (name of the parameter with the URDF), `motion` (zero: every joint
/// at zero, or in the middle of its range if zero is outside; sway: each joint moves around that), `rate`
/// (Hz, 50), `root_frame` (world; empty: no transform to the root link).

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <urdf_parser/urdf_parser.h>

#include <vector>

#include "concave_distance/base/error.h"
#include "demo_parameters.h"
#include "kinematics/frame_name.h"
#include "kinematics/urdf_values.h"
#include "loading/description_search.h"
#include "swaying_joints.h"

namespace {

using namespace concave_distance;

std::string waitForDescription(const ros::NodeHandle& node) {
  const std::string name =
      ros::param::param<std::string>(node.resolveName("robot_description"), "robot_description");
  while (ros::ok()) {
    const auto found = searchDescription(node.getNamespace(), name, [&](const std::string& key) {
      std::string text;
      return node.getParam(key, text) ? std::optional<std::string>(text) : std::nullopt;
    });
    if (found && found->is_xml) return found->text;
    ROS_WARN_STREAM_THROTTLE(5.0, "Waiting for the parameter '" << name << "' with a robot's URDF.");
    ros::WallDuration(0.1).sleep();
  }
  return "";
}

// The root link in its frame and floating joints at their origins.
void publishWhatStands(tf2_ros::StaticTransformBroadcaster& broadcaster, const urdf::ModelInterface& model,
                       const std::string& root_frame) {
  const ros::Time now = ros::Time::now();
  std::vector<geometry_msgs::TransformStamped> transforms;
  const std::string root = withoutLeadingSlash(model.getRoot()->name);
  if (!root_frame.empty() && root_frame != root) {
    transforms.push_back(demo::toTransform(Eigen::Isometry3d::Identity(), now, root_frame, root));
  }
  for (const auto& [name, joint] : model.joints_) {
    if (joint->type != urdf::Joint::FLOATING) continue;
    const std::string parent = withoutLeadingSlash(joint->parent_link_name);
    const std::string child = withoutLeadingSlash(joint->child_link_name);
    transforms.push_back(
        demo::toTransform(detail::toIsometry(joint->parent_to_joint_origin_transform), now, parent, child));
    ROS_INFO_STREAM("The floating joint '" << name << "' stands at its origin until something publishes the "
                                           << "transform from '" << parent << "' to '" << child
                                           << "' on /tf.");
  }
  if (!transforms.empty()) broadcaster.sendTransform(transforms);
}

void run() {
  const ros::NodeHandle node("~");
  const double rate = demo::numberParameter(node, "rate", 50.0, 0.1, 2000.0);
  const std::string motion = ros::param::param<std::string>(node.resolveName("motion"), "zero");
  if (motion != "zero" && motion != "sway") {
    throw Error(node.resolveName("motion"), "is '" + motion + "'", "set it to zero or sway");
  }
  const std::string text = waitForDescription(node);
  if (!ros::ok()) return;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model || !model->getRoot()) {
    throw Error("robot_description", "the URDF cannot be read", "check it with check_urdf");
  }
  tf2_ros::StaticTransformBroadcaster broadcaster;
  publishWhatStands(broadcaster, *model,
                    ros::param::param<std::string>(node.resolveName("root_frame"), "world"));

  sensor_msgs::JointState message;
  std::vector<demo::SwayingJoint> joints = demo::swayingJoints(*model);
  for (demo::SwayingJoint& joint : joints) {
    message.name.push_back(joint.name);
    if (motion == "zero") joint.amplitude = 0.0;
  }
  message.position.resize(joints.size());
  ros::NodeHandle public_node;
  ros::Publisher publisher = public_node.advertise<sensor_msgs::JointState>("joint_states", 1);
  demo::playAtRate(rate, [&](double time, const ros::Time& now) {
    for (std::size_t i = 0; i < joints.size(); ++i) message.position[i] = joints[i].at(time);
    message.header.stamp = now;
    publisher.publish(message);
  });
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::demo::runNode(argc, argv, "robot_mover", run);
}
