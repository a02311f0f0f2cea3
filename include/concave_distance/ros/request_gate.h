#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>

namespace concave_distance {

/// Lets requests in that take long: so many work at one time, so many more wait in the order they came, and
/// the next is refused at once.
class RequestGate {
 public:
  /// @param waiting_seconds that a request waits at the most before it is refused too
  RequestGate(std::uint32_t workers, std::uint32_t waiting, double waiting_seconds);

  /// The right to work; its destructor lets the next one in.
  class Place {
   public:
    explicit Place(RequestGate& gate) : gate_(&gate) {}
    ~Place() { gate_->leave(); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    RequestGate* gate_;
  };

  /// Waits until it is this request's turn. @throws Error when too many wait already, when no worker becomes
  /// free in time, or after stop()
  Place enter();

  /// Refuses everybody who waits or comes, and raises the flag that ends the work of those who are in.
  void stop();
  const std::atomic<bool>& stopped() const { return stopped_; }
  /// How many requests have been worked on.
  std::uint64_t ended() const { return ended_; }

 private:
  void leave();

  std::uint32_t workers_;
  std::uint32_t waiting_;
  std::chrono::duration<double> waiting_seconds_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::uint64_t> line_;  ///< who waits, in the order they came
  std::uint64_t next_ = 0;          ///< who comes next
  std::uint32_t working_ = 0;
  std::atomic<std::uint64_t> ended_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace concave_distance
