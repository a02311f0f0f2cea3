#include "concave_distance/ros/request_gate.h"

#include <string>

#include "concave_distance/base/error.h"

namespace concave_distance {

RequestGate::RequestGate(std::uint32_t workers, std::uint32_t waiting)
    : workers_(workers), waiting_(waiting) {}

RequestGate::Place RequestGate::enter() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!stopped_ && entered_ - left_ >= std::uint64_t{workers_} + waiting_) {
    throw Error("SERVICE BUSY",
                std::to_string(workers_) + " requests are worked on and " + std::to_string(waiting_) + " wait",
                "ask again later, one after the other, or raise ~limits/service_threads or ~limits/service_queue");
  }
  const std::uint64_t turn = entered_++;
  changed_.wait(lock, [&] { return stopped_ || turn < left_ + workers_; });
  if (stopped_) {
    ++left_;
    throw Error("service", "the node is shutting down", "ask again when it is back");
  }
  return Place(*this);
}

void RequestGate::leave() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++left_;
  }
  changed_.notify_all();
}

void RequestGate::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
}

}  // namespace concave_distance
