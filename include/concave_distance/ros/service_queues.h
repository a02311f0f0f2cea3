#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "concave_distance/ros/node_limits.h"
#include "concave_distance/ros/request_gate.h"

namespace concave_distance {

/// Queues and threads of their own for the services: one for requests that take long, behind a gate, and one
/// for those that do not. In a nodelet as well, whose manager's threads are for all its nodelets.
/// When roscpp shuts down it waits for running services; a thread sees that it has begun and ends their work.
/// It also gives memory back to the system after requests: malloc keeps what each thread has needed once.
class ServiceQueues {
 public:
  ServiceQueues(const ros::NodeHandle& node, const NodeLimits& limits);
  /// Ends what runs; the services themselves have to be gone by then.
  ~ServiceQueues();
  ServiceQueues(const ServiceQueues&) = delete;
  ServiceQueues& operator=(const ServiceQueues&) = delete;

  /// To advertise services with.
  const ros::NodeHandle& light() const { return light_node_; }
  const ros::NodeHandle& heavy() const { return heavy_node_; }
  RequestGate& gate() { return gate_; }

 private:
  void watch();

  RequestGate gate_;
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
