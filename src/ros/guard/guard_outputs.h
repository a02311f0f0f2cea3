#pragma once

#include <concave_distance/Constraints.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>
#include <vector>

#include "guard_parameters.h"

namespace concave_distance {

/// Publishes what a guard decides: scale, state, marker, and the scaled command.
class GuardOutputs {
 public:
  GuardOutputs(ros::NodeHandle& node, ros::NodeHandle& private_node, const GuardParameters& parameters);

  /// @param rows that it was decided by; nullptr: none have come @param words that say why
  void publish(const GuardDecision& decision, const Constraints* rows, const std::string& words,
               ros::Time now) const;
  /// @param velocities in the order of ~joints; empty: zeros
  void publishVelocities(const std::vector<double>& velocities, double scale) const;
  /// Keeps the frame; a scale of 0 gives zeros, whatever the numbers are.
  void publishTwist(const geometry_msgs::TwistStamped& twist, double scale, ros::Time now) const;

 private:
  void publishMarker(const GuardDecision& decision, const Constraints& rows, ros::Time now) const;

  GuardCommandKind command_;
  std::size_t joint_count_;
  ros::Publisher scale_publisher_;
  ros::Publisher state_publisher_;
  ros::Publisher command_publisher_;
  ros::Publisher marker_publisher_;
};

}  // namespace concave_distance
