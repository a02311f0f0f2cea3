#pragma once

#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <atomic>
#include <thread>

namespace concave_distance {

/// Publishes /clock in steps of 10 ms, in real time, from the first set() on.
class SimulatedClock {
 public:
  SimulatedClock()
      : publisher_(node_.advertise<rosgraph_msgs::Clock>("/clock", 10)), thread_([this] { run(); }) {}
  ~SimulatedClock() {
    running_ = false;
    thread_.join();
  }
  SimulatedClock(const SimulatedClock&) = delete;
  SimulatedClock& operator=(const SimulatedClock&) = delete;

  void set(double seconds) { time_ = seconds; }

 private:
  void run() {
    while (running_) {
      ros::WallDuration(0.01).sleep();
      double time = time_;
      // Not when set() came in between: its time stands.
      if (time > 0.0 && time_.compare_exchange_strong(time, time + 0.01)) {
        rosgraph_msgs::Clock message;
        message.clock = ros::Time(time + 0.01);
        publisher_.publish(message);
      }
    }
  }
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::atomic<double> time_{0.0};  ///< 0: the clock does not run
  std::atomic<bool> running_{true};
  std::thread thread_;
};

}  // namespace concave_distance
