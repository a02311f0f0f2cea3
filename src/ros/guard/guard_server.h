#pragma once

#include <concave_distance/Constraints.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "guard_parameters.h"
#include "message_places.h"

namespace concave_distance {

/// All of velocity_guard, shared by the program and the nodelet: wires topics and timer to the law. Every
/// message that comes and every tick decides and publishes.
class GuardServer {
 public:
  /// @param private_node for parameters, commands and answers
  /// @throws Error for a wrong parameter
  GuardServer(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  /// A command as it came.
  struct Command {
    ros::Time time;
    std::vector<double> velocities;     ///< in the order of ~joints
    geometry_msgs::TwistStamped twist;  ///< with the frame that it is in
  };

  void takeRows(const Constraints::ConstPtr& rows);
  /// Changes what is known and decides anew.
  template <typename Change>
  void act(const char* what, const Change& change);
  void act(ros::Time now);
  const GuardDecision& decide(double now);
  const GuardDecision& decideByJoints(bool is_commanded, double stamp, double now);
  const GuardDecision& decideByTwist(bool is_commanded, double stamp, double now);
  /// Decides 0, for a reason that is no place.
  const GuardDecision& stop(GuardReason reason, const std::string& words);
  bool hangsOnTwistFrame(std::string frame) const;

  std::mutex mutex_;
  GuardParameters parameters_;
  VelocityGuard guard_;
  MessagePlaces places_;
  Constraints::ConstPtr rows_;
  std::optional<Command> command_;
  std::string fault_;  ///< of the decision being made
  ros::Time last_now_;
  tf2_ros::Buffer buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;  ///< nullptr: no twist
  ros::Publisher scale_publisher_;
  ros::Publisher state_publisher_;
  ros::Subscriber row_subscriber_;
  ros::Subscriber command_subscriber_;
  ros::WallTimer timer_;
};

}  // namespace concave_distance
