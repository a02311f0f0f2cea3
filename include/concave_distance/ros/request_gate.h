#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace concave_distance {

/// Lets requests in that take long: so many work at one time, so many more wait in the order they came, and
/// the next is refused at once.
class RequestGate {
 public:
  RequestGate(std::uint32_t workers, std::uint32_t waiting);

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

  /// Waits until it is this request's turn. @throws Error when too many wait already, or after stop()
  Place enter();

  /// Refuses everybody who waits or comes, and raises the flag that ends the work of those who are in.
  void stop();
  const std::atomic<bool>& stopped() const { return stopped_; }

 private:
  void leave();

  std::uint32_t workers_;
  std::uint32_t waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t entered_ = 0;  ///< requests that have come, those refused left out
  std::uint64_t left_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace concave_distance
