#include "request_gate.h"

#include <algorithm>
#include <string>
#include <utility>

#include "concave_distance/base/error.h"

namespace concave_distance {

RequestGate::RequestGate(std::uint32_t workers, std::uint32_t waiting, double waiting_seconds,
                         std::string remedy)
    : workers_(workers), waiting_(waiting), waiting_seconds_(waiting_seconds), remedy_(std::move(remedy)) {}

RequestGate::Place RequestGate::enter() {
  const auto busy = [&](const std::string& what) { return Error("SERVICE BUSY", what, remedy_); };
  std::unique_lock<std::mutex> lock(mutex_);
  const bool has_to_wait = working_ >= workers_ || !line_.empty();
  if (!stopped_ && has_to_wait && line_.size() >= waiting_) {
    throw busy(std::to_string(workers_) + " requests run and " + std::to_string(waiting_) + " wait");
  }
  const std::uint64_t turn = next_++;
  line_.push_back(turn);
  const bool may_enter = changed_.wait_for(
      lock, waiting_seconds_, [&] { return stopped_ || (line_.front() == turn && working_ < workers_); });
  line_.erase(std::find(line_.begin(), line_.end(), turn));
  working_ += may_enter && !stopped_ ? 1 : 0;
  changed_.notify_all();  // the next one is at the front now
  if (stopped_) {
    throw Error("service", "the node is shutting down", "ask again when it is back");
  }
  if (!may_enter) {
    throw busy("no thread became free in time");
  }
  return Place(*this);
}

void RequestGate::leave() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    --working_;
    ++ended_;
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
