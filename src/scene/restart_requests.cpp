#include "restart_requests.h"

#include <utility>

namespace concave_distance {
namespace {

constexpr std::size_t kMostPairs = 10'000;

}  // namespace

void RestartRequests::requestAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_.all = true;
  pending_.pairs.clear();
}

void RestartRequests::request(const std::string& pair) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (pending_.all) return;
  pending_.pairs.insert(pair);
  // Without a cycle nothing takes them: a clock that stands still must not let them grow.
  if (pending_.pairs.size() <= kMostPairs) return;
  pending_.all = true;
  pending_.pairs.clear();
}

RestartRequests::Pending RestartRequests::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(pending_, Pending());
}

}  // namespace concave_distance
