#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/request_gate.h"
#include "node_limits.h"

namespace concave_distance {

/// Queues and threads for the services: one queue for long requests, behind a gate, and one for the others.
/// Also in a nodelet, because its manager's threads serve all its nodelets.
/// At shutdown roscpp waits for running services; a thread notices the shutdown and ends their work. It also
/// returns memory to the system after requests, because malloc keeps what each thread once needed.
class ServiceQueues {
 public:
  ServiceQueues(const ros::NodeHandle& node, const NodeLimits& limits);
  /// Ends running requests; destroy the services first.
  ~ServiceQueues();
  ServiceQueues(const ServiceQueues&) = delete;
  ServiceQueues& operator=(const ServiceQueues&) = delete;

  /// The node handle to advertise services with.
  const ros::NodeHandle& light() const { return light_node_; }
  const ros::NodeHandle& heavy() const { return heavy_node_; }
  RequestGate& gate() { return gate_; }
  /// For motions: one at a time, another waits, beside the requests of the other gate.
  RequestGate& motionGate() { return motion_gate_; }

 private:
  void watch();

  RequestGate gate_;
  RequestGate motion_gate_;
  ros::CallbackQueue light_queue_;
  ros::CallbackQueue heavy_queue_;
  ros::NodeHandle light_node_;
  ros::NodeHandle heavy_node_;
  ros::AsyncSpinner light_spinner_;
  ros::AsyncSpinner heavy_spinner_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::thread watcher_;
};

}  // namespace concave_distance
