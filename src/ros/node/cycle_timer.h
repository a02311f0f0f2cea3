#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace concave_distance {

/// Calls back at a rate of ROS time, on its own thread. ros::Timer ends the process when a simulated clock
/// comes near the largest ros::Time, because it adds periods to it; this one does not.
class CycleTimer {
 public:
  /// @param due when this call was due, nanoseconds of ROS time
  using Callback = std::function<void(std::int64_t due)>;

  explicit CycleTimer(Callback callback);
  ~CycleTimer();
  CycleTimer(const CycleTimer&) = delete;
  CycleTimer& operator=(const CycleTimer&) = delete;

  /// The first call comes one period from now. @param rate calls a second
  void start(double rate);
  /// Takes effect with the next call.
  void setRate(double rate);
  /// Waits for a running call.
  void stop();

 private:
  void run();
  bool waitUntilDue(std::unique_lock<std::mutex>& lock);

  const Callback callback_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::int64_t period_ = 0;  ///< ns
  std::int64_t due_ = 0;     ///< ns; 0: no call yet
  std::int64_t last_now_ = 0;
  std::thread thread_;
};

}  // namespace concave_distance
