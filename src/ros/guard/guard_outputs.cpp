#include "guard_outputs.h"

#include <concave_distance/GuardState.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <visualization_msgs/Marker.h>

#include <cmath>

#include "base/number_text.h"
#include "guard_words.h"

namespace concave_distance {
namespace {

// MoveIt Servo's own collision check has the same queue.
constexpr std::uint32_t kServoQueueLength = 2;
constexpr double kScaleTextHeight = 0.08;  // m, of a letter
constexpr double kScaleTextPlace = 1.2;    // m above the origin, where no place decides

static_assert(GuardState::FREE == static_cast<int>(GuardReason::Free));
static_assert(GuardState::BAD_COMMAND == static_cast<int>(GuardReason::BadCommand));

geometry_msgs::Vector3 scaledBy(double scale, const geometry_msgs::Vector3& vector) {
  geometry_msgs::Vector3 scaled;
  if (scale == 0.0) return scaled;
  scaled.x = scale * vector.x;
  scaled.y = scale * vector.y;
  scaled.z = scale * vector.z;
  return scaled;
}

}  // namespace

GuardOutputs::GuardOutputs(ros::NodeHandle& node, ros::NodeHandle& private_node,
                           const GuardParameters& parameters)
    : command_(parameters.command), joint_count_(parameters.joints ? parameters.joints->size() : 0) {
  scale_publisher_ = node.advertise<std_msgs::Float64>(parameters.scale_topic, kServoQueueLength);
  state_publisher_ = private_node.advertise<GuardState>("state", kServoQueueLength, true);
  marker_publisher_ = private_node.advertise<visualization_msgs::Marker>("marker", 1);
  switch (command_) {
    case GuardCommandKind::None:
      break;
    case GuardCommandKind::JointVelocities:
      command_publisher_ =
          private_node.advertise<std_msgs::Float64MultiArray>("joint_velocities_out", kServoQueueLength);
      break;
    case GuardCommandKind::Twist:
      command_publisher_ =
          private_node.advertise<geometry_msgs::TwistStamped>("twist_out", kServoQueueLength);
      break;
    case GuardCommandKind::CmdVel:
      command_publisher_ = private_node.advertise<geometry_msgs::Twist>("cmd_vel_out", kServoQueueLength);
      break;
  }
}

void GuardOutputs::publish(const GuardDecision& decision, const Constraints* rows, const std::string& words,
                           ros::Time now) const {
  std_msgs::Float64 scale;
  scale.data = decision.scale;
  scale_publisher_.publish(scale);
  GuardState state;
  state.header.stamp = now;
  state.scale = decision.scale;
  state.wanted = decision.wanted;
  state.reason = static_cast<std::uint8_t>(decision.reason);
  state.room = decision.room;
  state.closing = decision.closing;
  state.stopping_distance = decision.stopping_distance;
  state.message = words;
  if (rows != nullptr) {
    state.header.frame_id = rows->header.frame_id;
    state.pair = pairOf(decision, *rows);
  }
  state_publisher_.publish(state);
  if (rows != nullptr && marker_publisher_.getNumSubscribers() > 0) publishMarker(decision, *rows, now);
}

void GuardOutputs::publishVelocities(const std::vector<double>& velocities, double scale) const {
  std_msgs::Float64MultiArray message;
  message.data.assign(joint_count_, 0.0);
  for (std::size_t i = 0; scale > 0.0 && i < velocities.size(); ++i) message.data[i] = scale * velocities[i];
  command_publisher_.publish(message);
}

void GuardOutputs::publishTwist(const geometry_msgs::TwistStamped& twist, double scale, ros::Time now) const {
  geometry_msgs::TwistStamped message;
  message.header.stamp = now;
  message.header.frame_id = twist.header.frame_id;
  message.twist.linear = scaledBy(scale, twist.twist.linear);
  message.twist.angular = scaledBy(scale, twist.twist.angular);
  if (command_ == GuardCommandKind::Twist) command_publisher_.publish(message);
  if (command_ == GuardCommandKind::CmdVel) command_publisher_.publish(message.twist);
}

void GuardOutputs::publishMarker(const GuardDecision& decision, const Constraints& rows,
                                 ros::Time now) const {
  visualization_msgs::Marker marker;
  marker.header.frame_id = rows.header.frame_id;
  marker.header.stamp = now;
  marker.ns = "velocity_guard";
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.pose.orientation.w = 1.0;
  marker.pose.position.z = kScaleTextPlace;
  if (decision.id < rows.rows.size()) marker.pose.position = rows.rows[decision.id].point_a;
  marker.scale.z = kScaleTextHeight;
  marker.color.a = 1.0F;
  marker.color.r = static_cast<float>(1.0 - decision.scale);
  marker.color.g = static_cast<float>(decision.scale);
  TextStream text;
  text << "speed " << std::round(100.0 * decision.scale) << " % " << pairOf(decision, rows);
  marker.text = text.str();
  marker_publisher_.publish(marker);
}

}  // namespace concave_distance
