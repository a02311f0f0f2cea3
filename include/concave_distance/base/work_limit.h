#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace concave_distance {

/// How long a solve may work and how much memory its buffers may take. The stages of a solve share one and
/// ask it in every loop that can be long; what was refused is remembered until the solve ends. Without a
/// deadline and a stop flag a question costs a comparison; a look at the clock costs about 25 ns.
class WorkLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// No limit.
  WorkLimit() = default;

  /// @param seconds from `start`; infinite: no deadline
  /// @param memory_bytes of all buffers that hasRoom() and takeMemory() are asked for
  /// @param stop ends the work as soon as it is set; nullptr: nothing does
  WorkLimit(Clock::time_point start, double seconds, std::size_t memory_bytes, const std::atomic<bool>* stop)
      : start_(start), seconds_(seconds), stop_(stop), memory_(memory_bytes) {
    allowShare(1.0);
  }

  /// The deadline of the next stages as a share of the whole time; what was over by an earlier one may go on.
  void allowShare(double share) {
    is_timed_ = share * seconds_ < kLongest;
    if (is_timed_)
      deadline_ = start_ + std::chrono::duration_cast<Clock::duration>(Duration(share * seconds_));
    is_over_ = false;
    until_look_ = 0;
  }

  /// Whether the work has to end: the deadline has passed or the stop flag is set.
  bool isOver() {
    if (is_over_ || (!is_timed_ && stop_ == nullptr)) return is_over_;
    const bool is_stopped = stop_ != nullptr && stop_->load(std::memory_order_relaxed);
    if (!is_stopped && !(is_timed_ && Clock::now() >= deadline_)) return false;
    time_refused_ = is_over_ = true;
    return true;
  }

  /// The same for loops whose turns take less than a microsecond: every 32nd call looks.
  bool isOverNow() {
    if (is_over_ || (!is_timed_ && stop_ == nullptr)) return is_over_;
    if (until_look_-- > 0) return false;
    until_look_ = kCallsBetweenLooks;
    return isOver();
  }

  /// Whether `more` elements may be added. Counts what the vector's growth takes.
  template <typename T>
  bool hasRoom(const std::vector<T>& buffer, std::size_t more = 1) {
    const std::size_t needed = buffer.size() + more;
    if (needed <= buffer.capacity()) return true;
    const std::size_t grown = std::max(needed, 2 * buffer.capacity()) * sizeof(T);
    if (!takeMemory(grown)) return false;
    returnMemory(buffer.capacity() * sizeof(T));  // the old elements go when the new ones are in place
    return true;
  }

  /// Counts memory as taken, or refuses it.
  bool takeMemory(std::size_t bytes) {
    if (bytes > memory_ || taken_ > memory_ - bytes) {
      memory_refused_ = true;
      return false;
    }
    taken_ += bytes;
    return true;
  }
  void returnMemory(std::size_t bytes) { taken_ -= std::min(bytes, taken_); }
  /// What buffers hold that were there before.
  void setTaken(std::size_t bytes) { taken_ = bytes; }
  std::size_t taken() const { return taken_; }

  bool isTimed() const { return is_timed_; }
  /// Whether anything was refused: what was computed is not all that was asked for.
  bool hasRefusedTime() const { return time_refused_; }
  bool hasRefusedMemory() const { return memory_refused_; }
  bool hasRefused() const { return time_refused_ || memory_refused_; }

 private:
  using Duration = std::chrono::duration<double>;
  static constexpr std::uint32_t kCallsBetweenLooks = 31;
  static constexpr double kLongest = 1e9;  ///< seconds that the clock can count from now on

  Clock::time_point start_;
  Clock::time_point deadline_;
  double seconds_ = std::numeric_limits<double>::infinity();
  const std::atomic<bool>* stop_ = nullptr;
  std::size_t memory_ = std::numeric_limits<std::size_t>::max();
  std::size_t taken_ = 0;
  std::uint32_t until_look_ = 0;
  bool is_timed_ = false;
  bool is_over_ = false;
  bool time_refused_ = false;
  bool memory_refused_ = false;
};

/// Gives memory taken inside a scope back at its end: of buffers that are freed there.
class MemoryScope {
 public:
  explicit MemoryScope(WorkLimit& limit) : limit_(limit), taken_(limit.taken()) {}
  ~MemoryScope() { limit_.setTaken(taken_); }
  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

 private:
  WorkLimit& limit_;
  std::size_t taken_;
};

}  // namespace concave_distance
