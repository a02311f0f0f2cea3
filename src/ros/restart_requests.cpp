#include "concave_distance/ros/restart_requests.h"

#include <utility>

namespace concave_distance {

void RestartRequests::requestAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_.all = true;
  pending_.pairs.clear();
}

void RestartRequests::request(const std::string& pair) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!pending_.all) pending_.pairs.insert(pair);
}

RestartRequests::Pending RestartRequests::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(pending_, Pending());
}

}  // namespace concave_distance
