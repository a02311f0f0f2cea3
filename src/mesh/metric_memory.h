#pragma once

#include <atomic>
#include <cstddef>

namespace concave_distance {

/// A limit on the memory of the matrices of several mesh metrics. Thread-safe.
class MetricMemory {
 public:
  /// @param limit bytes
  explicit MetricMemory(std::size_t limit) : limit_(limit) {}

  std::size_t limit() const { return limit_; }
  std::size_t used() const { return used_; }
  /// Takes memory; false, without taking any, when less than this is left.
  bool take(std::size_t bytes) {
    std::size_t used = used_;
    while (bytes <= limit_ - used) {
      if (used_.compare_exchange_weak(used, used + bytes)) return true;
    }
    return false;
  }
  void giveBack(std::size_t bytes) { used_ -= bytes; }

 private:
  std::size_t limit_;
  std::atomic<std::size_t> used_{0};
};

}  // namespace concave_distance
