#pragma once

#include <concave_distance/Constraints.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <std_msgs/Float64MultiArray.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "guard_outputs.h"
#include "guard_parameters.h"
#include "message_places.h"

namespace concave_distance {

/// All of velocity_guard, shared by the program and the nodelet: wires topics, timer and diagnostics to the
/// law. Every message that comes and every tick decides and publishes.
class GuardServer {
 public:
  /// @param node for tf and diagnostics @param private_node for parameters and topics
  /// @param name of the node or nodelet, for the diagnostics
  /// @throws Error for a wrong parameter
  GuardServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name);

 private:
  /// A command as it came.
  struct Command {
    ros::Time time;
    std::vector<double> velocities;     ///< in the order of ~joints
    geometry_msgs::TwistStamped twist;  ///< with the frame that it is in
  };

  void subscribe();
  void onConstraints(const Constraints::ConstPtr& message);
  void onVelocities(const std_msgs::Float64MultiArray::ConstPtr& message);
  void onTwist(const geometry_msgs::TwistStamped& message);
  void act(ros::Time now);
  const GuardDecision& decide(ros::Time now);
  const GuardDecision& decideByJoints(double stamp, double now);
  const GuardDecision& decideByTwist(double stamp, double now);
  std::optional<GuardTwist> readTwist();
  bool hangsOnTwistFrame(const std::string& frame);
  bool hasCommand(ros::Time now) const;
  /// Returns why the command cannot be used; empty: it can.
  std::string faultOf(const Command& command) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::mutex mutex_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  GuardParameters parameters_;
  VelocityGuard guard_;
  GuardOutputs outputs_;
  MessagePlaces places_;
  Constraints::ConstPtr rows_;
  std::optional<Command> command_;
  std::string fault_;  ///< of the decision being made
  std::string words_;  ///< of the last decision
  ros::Time last_now_;
  std::unique_ptr<tf2_ros::Buffer> buffer_;  ///< nullptr: no twist
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  std::map<std::string, bool> hangs_;  ///< of the decision being made: frames that hang on ~twist_frame
  ros::Subscriber constraint_subscriber_;
  ros::Subscriber command_subscriber_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace concave_distance
