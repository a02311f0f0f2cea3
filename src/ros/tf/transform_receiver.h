#pragma once

#include <ros/callback_queue.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "base/log_throttle.h"
#include "transform_buffer.h"

namespace concave_distance {

/// Counts what arrived since the last call of take().
struct TransformReport {
  std::size_t frames = 0;  ///< known at present
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;
  std::uint64_t refused_in_all = 0;  ///< since the start
  std::string last_refusal;          ///< frame, sender, reason and remedy; empty when there was none
};

/// Subscribes to /tf and /tf_static and fills the buffer, on its own thread; logs refused transforms.
class TransformReceiver {
 public:
  TransformReceiver(const ros::NodeHandle& node, TransformBuffer& buffer);
  ~TransformReceiver();
  TransformReceiver(const TransformReceiver&) = delete;
  TransformReceiver& operator=(const TransformReceiver&) = delete;

  /// Also logs refusals not logged yet: call it about once a second.
  TransformReport take();

 private:
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  void receive(const Event& event, bool fixed);
  void note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
            const TransformProblem& problem);
  void logRefusals();

  TransformBuffer& buffer_;
  std::mutex mutex_;
  TransformReport report_;
  std::uint64_t unlogged_ = 0;  ///< refused since the last line in the log
  std::string last_sender_;
  LogThrottle throttle_;

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Subscriber moving_;
  ros::Subscriber fixed_;
  ros::AsyncSpinner spinner_;
};

}  // namespace concave_distance
