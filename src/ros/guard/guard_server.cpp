#include "guard_server.h"

#include <concave_distance/GuardState.h>
#include <ros/console.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "guard_words.h"
#include "ros/callback_guard.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr const char* kRowsTopic = "/concave_distance/constraints";
constexpr std::uint32_t kScaleQueueLength = 2;  // that of MoveIt Servo's own collision check
constexpr int kFrameHops = 100;                 // a longer chain of tf frames is a loop

GuardParameters readGuardParameters(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue values;
  node.getParam("", values);
  std::vector<std::string> unknown;
  GuardParameters parameters = parseGuardParameters(values, unknown);
  for (const std::string& name : unknown) {
    ROS_WARN_STREAM("The parameter '" << node.resolveName(name)
                                      << "' is not known to this node: a spelling mistake?");
  }
  return parameters;
}

Eigen::Vector3d vectorOf(const geometry_msgs::Vector3& vector) {
  return {vector.x, vector.y, vector.z};
}

}  // namespace

template <typename Change>
void GuardServer::act(const char* what, const Change& change) {
  guarded(what, [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
    act(ros::Time::now());
  });
}

GuardServer::GuardServer(ros::NodeHandle node, ros::NodeHandle private_node)
    : parameters_(readGuardParameters(private_node)), guard_(parameters_.guard) {
  scale_publisher_ = private_node.advertise<std_msgs::Float64>("scale", kScaleQueueLength);
  state_publisher_ = private_node.advertise<GuardState>("state", kScaleQueueLength, true);
  row_subscriber_ =
      node.subscribe(kRowsTopic, 1, &GuardServer::takeRows, this, ros::TransportHints().tcpNoDelay());
  if (parameters_.joints) {
    command_subscriber_ = private_node.subscribe<std_msgs::Float64MultiArray>(
        "joint_velocities", 1, [this](const std_msgs::Float64MultiArray::ConstPtr& message) {
          act("Taking a command", [&] { command_ = Command{ros::Time::now(), message->data, {}}; });
        });
  } else if (!parameters_.twist_frame.empty()) {
    listener_ = std::make_unique<tf2_ros::TransformListener>(buffer_, node);
    command_subscriber_ = private_node.subscribe<geometry_msgs::TwistStamped>(
        "twist", 1, [this](const geometry_msgs::TwistStamped::ConstPtr& message) {
          act("Taking a command", [&] { command_ = Command{ros::Time::now(), {}, *message}; });
        });
  }
  timer_ = private_node.createWallTimer(ros::WallDuration(1.0 / parameters_.rate),
                                        [this](const auto&) { act("The guard's timer", [] {}); });
}

void GuardServer::takeRows(const Constraints::ConstPtr& rows) {
  act("Taking rows", [&] {
    rows_ = rows;
    places_.measure(*rows);
  });
}

void GuardServer::act(ros::Time now) {
  if (now < last_now_) {
    rows_.reset();  // of the time before the jump
    command_.reset();
    places_ = {};
  }
  last_now_ = now;
  fault_.clear();
  const GuardDecision decision = decide(now.toSec());
  std_msgs::Float64 scale;
  scale.data = decision.scale;
  scale_publisher_.publish(scale);
  GuardState state;
  state.header.stamp = now;
  state.scale = decision.scale;
  if (rows_) state.header.frame_id = rows_->header.frame_id;
  state.reason = fault_.empty()
                     ? wordsFor(decision, *rows_, parameters_.guard, secondsBetween(rows_->transforms, now))
                     : fault_;
  state_publisher_.publish(state);
}

const GuardDecision& GuardServer::stop(GuardReason reason, const std::string& words) {
  fault_ = words;
  return guard_.stop(reason, last_now_.toSec());
}

const GuardDecision& GuardServer::decide(double now) {
  if (!rows_) {
    return stop(GuardReason::NoRows,
                "no rows have come yet; check the topic " + row_subscriber_.getTopic() + " and its node");
  }
  if (!rows_->problems.empty()) return stop(GuardReason::Unknown, rows_->problems.front());
  const double stamp = rows_->transforms.toSec();
  // What is older counts as a command of zeros.
  const bool is_commanded = command_ && std::abs(now - command_->time.toSec()) <= parameters_.command_timeout;
  if (parameters_.joints) return decideByJoints(is_commanded, stamp, now);
  if (listener_) return decideByTwist(is_commanded, stamp, now);
  return guard_.decide(places_.ofTwist(*rows_, nullptr, guard_.last().scale), 0.0, stamp, now);
}

const GuardDecision& GuardServer::decideByJoints(bool is_commanded, double stamp, double now) {
  const std::vector<std::string>& joints = *parameters_.joints;
  if (is_commanded && command_->velocities.size() != joints.size()) {
    return stop(GuardReason::BadCommand, "the command has " + std::to_string(command_->velocities.size()) +
                                             " numbers; ~joints names " + std::to_string(joints.size()) +
                                             " joints: send one for each");
  }
  std::vector<double> velocities(rows_->joints.size(), 0.0);
  double fastest = 0.0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto found = std::find(rows_->joints.begin(), rows_->joints.end(), joints[i]);
    if (found == rows_->joints.end()) {
      return stop(GuardReason::BadCommand,
                  "joint '" + joints[i] + "' is not among the joints of the rows; check its prefix");
    }
    if (!is_commanded) continue;
    const double velocity = command_->velocities[i];
    if (!std::isfinite(velocity)) {
      return stop(GuardReason::NotFinite, "the command for joint '" + joints[i] + "' is not finite");
    }
    velocities[static_cast<std::size_t>(found - rows_->joints.begin())] = velocity;
    fastest = std::max(fastest, std::abs(velocity));
  }
  const double braking = fastest / parameters_.guard.joint_deceleration.value_or(INFINITY);
  return guard_.decide(places_.ofJoints(*rows_, velocities), braking, stamp, now);
}

// By the velocity of the frame's origin and its turning, in the rows' frame.
const GuardDecision& GuardServer::decideByTwist(bool is_commanded, double stamp, double now) {
  const geometry_msgs::TwistStamped given = is_commanded ? command_->twist : geometry_msgs::TwistStamped();
  const Eigen::Vector3d linear = vectorOf(given.twist.linear);
  const Eigen::Vector3d angular = vectorOf(given.twist.angular);
  if (!linear.allFinite() || !angular.allFinite())
    return stop(GuardReason::NotFinite, "a number of the commanded twist is not finite");
  GuardTwist twist;
  twist.moves = [this](const std::string& frame) { return hangsOnTwistFrame(frame); };
  try {
    const std::string& reference = rows_->header.frame_id;
    std::string frame = given.header.frame_id.empty() ? parameters_.twist_frame : given.header.frame_id;
    if (frame[0] == '/') frame.erase(0, 1);
    const auto place = buffer_.lookupTransform(reference, parameters_.twist_frame, ros::Time(0)).transform;
    const auto turn = buffer_.lookupTransform(reference, frame, ros::Time(0)).transform.rotation;
    const Eigen::Quaterniond reference_from_given(turn.w, turn.x, turn.y, turn.z);
    twist.twist.angular = reference_from_given * angular;
    twist.twist.linear =
        reference_from_given * linear - twist.twist.angular.cross(vectorOf(place.translation));
  } catch (const tf2::TransformException& problem) {
    return stop(GuardReason::BadCommand, std::string("the frame of the twist is not known: ") +
                                             problem.what() +
                                             "; check ~twist_frame and the command's header");
  }
  const double turning = angular.norm() / parameters_.guard.joint_deceleration.value_or(INFINITY);
  return guard_.decide(places_.ofTwist(*rows_, &twist, guard_.last().scale),
                       std::max(turning, linear.norm() / parameters_.guard.deceleration), stamp, now);
}

bool GuardServer::hangsOnTwistFrame(std::string frame) const {
  for (int hops = 0; frame != parameters_.twist_frame; ++hops) {
    std::string parent;
    if (hops == kFrameHops || !buffer_._getParent(frame, ros::Time(0), parent)) return false;
    frame = parent;
  }
  return true;
}

}  // namespace concave_distance
