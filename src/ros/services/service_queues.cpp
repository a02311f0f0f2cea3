#include "service_queues.h"

#include <malloc.h>
#include <ros/init.h>

#include <chrono>

namespace concave_distance {
namespace {

constexpr std::uint32_t kLightThreads = 2;   // so that reading the scene does not wait for an edit
constexpr std::uint32_t kMotionThreads = 3;  // one motion runs, one waits, one is refused
constexpr std::chrono::milliseconds kWatchPeriod{20};
constexpr std::chrono::seconds kReturnPeriod{5};

ros::NodeHandle onQueue(const ros::NodeHandle& node, ros::CallbackQueue& queue) {
  ros::NodeHandle handle(node);
  handle.setCallbackQueue(&queue);
  return handle;
}

}  // namespace

ServiceQueues::ServiceQueues(const ros::NodeHandle& node, const NodeLimits& limits)
    : gate_(limits.service_threads, limits.service_queue, limits.query_seconds),
      motion_gate_(1, 1, limits.clearance_seconds, "send motions one at a time, or cancel_clearance"),
      light_node_(onQueue(node, light_queue_)),
      heavy_node_(onQueue(node, heavy_queue_)),
      light_spinner_(kLightThreads, &light_queue_),
      // One thread per running or waiting request, and one that refuses the next.
      heavy_spinner_(limits.service_threads + limits.service_queue + 1 + kMotionThreads, &heavy_queue_),
      watcher_([this] { watch(); }) {
  light_spinner_.start();
  heavy_spinner_.start();
}

ServiceQueues::~ServiceQueues() {
  gate_.stop();
  motion_gate_.stop();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  ending_.notify_all();
  watcher_.join();
  heavy_spinner_.stop();
  light_spinner_.stop();
}

// Polls, because roscpp announces its shutdown only by a flag before it waits for the services.
void ServiceQueues::watch() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_look = Clock::now();
  std::uint64_t ended = 0;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_.wait_for(lock, kWatchPeriod, [this] { return ends_; })) {
    if (ros::isShuttingDown()) {
      gate_.stop();
      motion_gate_.stop();
      return;
    }
    if (Clock::now() - last_look < kReturnPeriod) continue;
    last_look = Clock::now();
    if (gate_.ended() + motion_gate_.ended() == ended) continue;
    ended = gate_.ended() + motion_gate_.ended();
    malloc_trim(0);
  }
}

}  // namespace concave_distance
