#pragma once

#include <mutex>
#include <set>
#include <string>

namespace concave_distance {

/// Carries the wish to start pairs anew from a service to the cycle's thread. Thread-safe.
class RestartRequests {
 public:
  struct Pending {
    bool all = false;
    std::set<std::string> pairs;
  };
  void requestAll();
  /// Asks for the restart of a pair. When more than 10,000 are asked for at once, all are restarted.
  void request(const std::string& pair);
  /// Returns what has come in since the last call.
  Pending take();

 private:
  std::mutex mutex_;
  Pending pending_;
};

}  // namespace concave_distance
