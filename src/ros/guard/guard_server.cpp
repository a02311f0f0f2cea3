#include "guard_server.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "guard_words.h"
#include "ros/callback_guard.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr double kGuardLogPeriod = 5.0;  // s, between two warnings
constexpr int kFrameHops = 100;          // a longer chain of tf frames is a loop

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

bool isFault(GuardReason reason) {
  return reason != GuardReason::Free && reason != GuardReason::Closing && reason != GuardReason::Rising;
}

}  // namespace

GuardServer::GuardServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                         const std::string& name)
    : node_(node),
      private_node_(private_node),
      parameters_(readGuardParameters(private_node)),
      guard_(parameters_.guard),
      outputs_(node_, private_node_, parameters_),
      updater_(node, ros::NodeHandle(private_node, "diagnostic_updater"), name) {
  updater_.setHardwareID("none");
  updater_.add("scale", [this](auto& status) { diagnose(status); });
  subscribe();
  timer_ = private_node_.createWallTimer(ros::WallDuration(1.0 / parameters_.rate), [this](const auto&) {
    guarded("The guard's timer", [&] {
      updater_.update();
      const std::lock_guard<std::mutex> lock(mutex_);
      act(ros::Time::now());
    });
  });
}

void GuardServer::subscribe() {
  constraint_subscriber_ = node_.subscribe(parameters_.constraints_topic, 1, &GuardServer::onConstraints,
                                           this, ros::TransportHints().tcpNoDelay());
  if (parameters_.command == GuardCommandKind::JointVelocities) {
    command_subscriber_ = private_node_.subscribe("joint_velocities_in", 1, &GuardServer::onVelocities, this);
  }
  if (parameters_.command == GuardCommandKind::Twist || parameters_.command == GuardCommandKind::CmdVel) {
    buffer_ = std::make_unique<tf2_ros::Buffer>();
    listener_ = std::make_unique<tf2_ros::TransformListener>(*buffer_, node_);
  }
  if (parameters_.command == GuardCommandKind::Twist) {
    command_subscriber_ = private_node_.subscribe<geometry_msgs::TwistStamped>(
        "twist_in", 1, [this](const geometry_msgs::TwistStamped::ConstPtr& message) { onTwist(*message); });
  }
  if (parameters_.command == GuardCommandKind::CmdVel) {
    command_subscriber_ = private_node_.subscribe<geometry_msgs::Twist>(
        "cmd_vel_in", 1, [this](const geometry_msgs::Twist::ConstPtr& message) {
          geometry_msgs::TwistStamped stamped;
          stamped.twist = *message;
          onTwist(stamped);
        });
  }
}

void GuardServer::onConstraints(const Constraints::ConstPtr& message) {
  guarded("Taking rows", [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    rows_ = message;
    places_.measure(*message);
    act(ros::Time::now());
  });
}

void GuardServer::onVelocities(const std_msgs::Float64MultiArray::ConstPtr& message) {
  guarded("Taking a command", [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time now = ros::Time::now();
    command_ = Command{now, message->data, {}};
    act(now);
  });
}

void GuardServer::onTwist(const geometry_msgs::TwistStamped& message) {
  guarded("Taking a command", [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time now = ros::Time::now();
    command_ = Command{now, {}, message};
    act(now);
  });
}

bool GuardServer::hasCommand(ros::Time now) const {
  return command_ && std::abs(secondsBetween(command_->time, now)) <= parameters_.command_timeout;
}

std::string GuardServer::faultOf(const Command& command) const {
  TextStream text;
  if (parameters_.command == GuardCommandKind::JointVelocities) {
    const std::size_t wanted = parameters_.joints->size();
    if (command.velocities.size() != wanted) {
      text << "the command has " << command.velocities.size() << " numbers; ~joints names " << wanted
           << " joints: send one for each";
      return text.str();
    }
    for (std::size_t i = 0; i < wanted; ++i) {
      if (std::isfinite(command.velocities[i])) continue;
      return "the command for joint '" + (*parameters_.joints)[i] + "' is not finite";
    }
    return "";
  }
  const geometry_msgs::Twist& twist = command.twist.twist;
  const bool is_finite = vectorOf(twist.linear).allFinite() && vectorOf(twist.angular).allFinite();
  return is_finite ? "" : "a number of the commanded twist is not finite";
}

void GuardServer::act(ros::Time now) {
  if (now < last_now_) {
    rows_.reset();  // of the time before the jump
    command_.reset();
    places_.reset();
  }
  last_now_ = now;
  fault_.clear();
  hangs_.clear();
  const GuardDecision decision = decide(now);
  const double age = rows_ ? secondsBetween(rows_->transforms, now) : 0.0;
  words_ = wordsFor(decision, rows_.get(), parameters_.guard, age, fault_);
  if (isFault(decision.reason)) ROS_WARN_STREAM_THROTTLE(kGuardLogPeriod, "The scale is 0: " << words_);
  outputs_.publish(decision, rows_.get(), words_, now);
  if (!command_) return;  // from the first command on: zeros where none comes, or a wrong one
  const bool is_good = hasCommand(now) && faultOf(*command_).empty();
  if (parameters_.command == GuardCommandKind::JointVelocities) {
    outputs_.publishVelocities(is_good ? command_->velocities : std::vector<double>(), decision.scale);
  } else {
    outputs_.publishTwist(command_->twist, is_good ? decision.scale : 0.0, now);
  }
}

const GuardDecision& GuardServer::decide(ros::Time now) {
  const double seconds = now.toSec();
  if (hasCommand(now)) {
    fault_ = faultOf(*command_);
    if (!fault_.empty()) {
      const bool is_number = fault_.find("finite") != std::string::npos;
      return guard_.stop(is_number ? GuardReason::NotFinite : GuardReason::BadCommand, seconds);
    }
  }
  if (!rows_) return guard_.stop(GuardReason::NoRows, seconds);
  if (!rows_->problems.empty()) {
    fault_ = rows_->problems.front();
    return guard_.stop(GuardReason::Unknown, seconds);
  }
  const double stamp = rows_->transforms.toSec();
  switch (parameters_.command) {
    case GuardCommandKind::None:
      return guard_.decide(places_.asMeasured(*rows_, guard_.last().scale), 0.0, stamp, seconds);
    case GuardCommandKind::JointVelocities:
      return decideByJoints(stamp, seconds);
    default:
      return decideByTwist(stamp, seconds);
  }
}

const GuardDecision& GuardServer::decideByJoints(double stamp, double now) {
  std::vector<double> velocities(rows_->joints.size(), 0.0);
  double fastest = 0.0;
  for (std::size_t i = 0; i < parameters_.joints->size(); ++i) {
    const std::string& name = (*parameters_.joints)[i];
    const auto found = std::find(rows_->joints.begin(), rows_->joints.end(), name);
    if (found == rows_->joints.end()) {
      fault_ = "joint '" + name +
               "' is not among the joints of the rows: its robot has left, or its name there has a prefix";
      return guard_.stop(GuardReason::BadCommand, now);
    }
    if (!hasCommand(last_now_)) continue;
    velocities[static_cast<std::size_t>(found - rows_->joints.begin())] = command_->velocities[i];
    fastest = std::max(fastest, std::abs(command_->velocities[i]));
  }
  const auto& deceleration = parameters_.guard.joint_deceleration;
  return guard_.decide(places_.ofJoints(*rows_, velocities), deceleration ? fastest / *deceleration : 0.0,
                       stamp, now);
}

const GuardDecision& GuardServer::decideByTwist(double stamp, double now) {
  const std::optional<GuardTwist> twist = readTwist();
  if (!twist) return guard_.stop(GuardReason::BadCommand, now);
  double braking = 0.0;
  if (hasCommand(last_now_)) {
    const geometry_msgs::Twist& given = command_->twist.twist;
    braking = vectorOf(given.linear).norm() / parameters_.guard.deceleration;
    if (parameters_.guard.joint_deceleration) {
      braking = std::max(braking, vectorOf(given.angular).norm() / *parameters_.guard.joint_deceleration);
    }
  }
  return guard_.decide(places_.ofTwist(*rows_, *twist, guard_.last().scale), braking, stamp, now);
}

// The velocity of the frame's origin and its turning, in the rows' frame; no command is a twist of zeros.
std::optional<GuardTwist> GuardServer::readTwist() {
  GuardTwist read;
  read.moves = [this](const std::string& frame) { return hangsOnTwistFrame(frame); };
  const std::string& reference = rows_->header.frame_id;
  try {
    const auto transform =
        buffer_->lookupTransform(reference, parameters_.twist_frame, ros::Time(0)).transform;
    if (!hasCommand(last_now_)) return read;
    const std::string given = command_->twist.header.frame_id;
    const std::string frame = given.empty()     ? parameters_.twist_frame
                              : given[0] == '/' ? given.substr(1)
                                                : given;
    const auto turn = buffer_->lookupTransform(reference, frame, ros::Time(0)).transform.rotation;
    const Eigen::Quaterniond reference_from_given(turn.w, turn.x, turn.y, turn.z);
    read.twist.angular = reference_from_given * vectorOf(command_->twist.twist.angular);
    read.twist.linear = reference_from_given * vectorOf(command_->twist.twist.linear) -
                        read.twist.angular.cross(vectorOf(transform.translation));
    return read;
  } catch (const tf2::TransformException& problem) {
    fault_ = std::string("the frame of the twist is not known: ") + problem.what() +
             "; check ~twist_frame and the command's header";
    return std::nullopt;
  }
}

bool GuardServer::hangsOnTwistFrame(const std::string& frame) {
  const auto known = hangs_.find(frame);
  if (known != hangs_.end()) return known->second;
  std::string at = frame;
  bool hangs = at == parameters_.twist_frame;
  for (int hops = 0; !hangs && hops < kFrameHops; ++hops) {
    std::string parent;
    if (!buffer_->_getParent(at, ros::Time(0), parent)) break;
    at = parent;
    hangs = at == parameters_.twist_frame;
  }
  return hangs_[frame] = hangs;
}

void GuardServer::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const GuardDecision& last = guard_.last();
  status.summary(isFault(last.reason) ? 2 : last.scale == 0.0 ? 1 : 0, words_);
  status.add("scale", last.scale);
  status.add("pair", rows_ ? pairOf(last, *rows_) : "");
}

}  // namespace concave_distance
