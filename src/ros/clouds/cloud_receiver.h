#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <topic_tools/shape_shifter.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/log_throttle.h"
#include "cloud_voxels.h"
#include "ros/tf/transform_buffer.h"
#include "ros/topics/cloud_report.h"
#include "ros/topics/scene_store.h"

namespace concave_distance {

/// Makes one cloud's messages into its body, on a thread of its own that gives way to others: always the
/// newest message, no more often than the cloud's rate.
class CloudReceiver {
 public:
  /// @param node whose namespace a relative topic is in
  /// @param body of a cloud, in the scene that is served
  /// @param transform_timeout seconds to wait for tf at a message's stamp
  CloudReceiver(ros::NodeHandle node, const SceneBody& body, SceneStore& keeper,
                const TransformBuffer& transforms, double transform_timeout);
  /// Waits for the message that is being made into a body.
  ~CloudReceiver();
  CloudReceiver(const CloudReceiver&) = delete;
  CloudReceiver& operator=(const CloudReceiver&) = delete;

  /// Returns whether this is the cloud of a body.
  bool isOf(const SceneBody& body) const;
  /// Returns what became of the messages, some of it since the last call.
  CloudReport take();

 private:
  using Clock = std::chrono::steady_clock;
  struct Arrival {
    topic_tools::ShapeShifter::ConstPtr message;
    Clock::time_point time;
  };

  void receive(const topic_tools::ShapeShifter::ConstPtr& message);
  void subscribe();
  void waitForMessage(std::unique_lock<std::mutex>& lock);
  void work();
  void use(const Arrival& arrival);
  void serve(const SceneBody& body, const CloudVoxels& made, ros::Time stamp);

  ros::NodeHandle node_;
  std::string name_;
  std::string frame_;
  std::shared_ptr<const CloudSettings> settings_;
  SceneStore& keeper_;
  const TransformBuffer& transforms_;
  double transform_timeout_;

  std::mutex mutex_;  ///< of the following
  std::condition_variable arrived_;
  Arrival newest_;
  bool is_ending_ = false;
  CloudReport report_;
  LogThrottle throttle_;

  // The thread alone uses these:
  bool has_other_type_ = false;  ///< the newest message
  Clock::time_point subscribed_;
  ros::Subscriber subscriber_;
  std::thread thread_;  ///< last member: it begins when the others are there
};

}  // namespace concave_distance
