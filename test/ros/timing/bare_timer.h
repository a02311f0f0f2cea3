#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace concave_distance {

/// What the machine itself makes late: a thread that sleeps to a period and does nothing, while it lives.
class BareTimer {
 public:
  /// @param period seconds
  explicit BareTimer(double period);
  ~BareTimer();
  BareTimer(const BareTimer&) = delete;
  BareTimer& operator=(const BareTimer&) = delete;

  void stop();
  std::uint64_t cycles() const { return cycles_; }
  /// Cycles in which it woke after the next one was due.
  std::uint64_t late() const { return late_; }

 private:
  void run(double period);

  std::atomic<bool> running_{true};
  std::atomic<std::uint64_t> cycles_{0};
  std::atomic<std::uint64_t> late_{0};
  std::thread thread_;
};

}  // namespace concave_distance
