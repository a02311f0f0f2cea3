#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

namespace concave_distance {

/// Limits requests that take long: some run at one time, some wait in the order in which they came, and the
/// next is refused at once.
class RequestGate {
 public:
  /// @param waiting_seconds longest wait of a request before it is refused, too
  /// @param remedy for requests that are refused
  RequestGate(std::uint32_t workers, std::uint32_t waiting, double waiting_seconds,
              std::string remedy =
                  "send requests later, one at a time, or raise ~limits/service_threads or "
                  "~limits/service_queue");

  /// Permission to run; the destructor lets the next request run.
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

  /// Refuses waiting and later requests, and sets the flag that ends running ones.
  void stop();
  const std::atomic<bool>& stopped() const { return stopped_; }
  /// Number of requests that have run.
  std::uint64_t ended() const { return ended_; }

 private:
  void leave();

  std::uint32_t workers_;
  std::uint32_t waiting_;
  std::chrono::duration<double> waiting_seconds_;
  std::string remedy_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::uint64_t> line_;  ///< waiting requests, in the order in which they came
  std::uint64_t next_ = 0;          ///< number of the next request
  std::uint32_t working_ = 0;
  std::atomic<std::uint64_t> ended_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace concave_distance
