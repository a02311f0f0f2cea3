#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace concave_distance {

/// Limits the time and the memory of a solve. All its stages share one limit and ask it in every loop that
/// can be long; a refusal is remembered until the solve ends. Without deadline and stop flag, asking costs a
/// comparison; reading the clock costs about 25 ns.
class WorkLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// No limit.
  WorkLimit() = default;

  /// @param seconds from `start`; infinite: no deadline
  /// @param memory_bytes for all buffers that makeRoom() and takeMemory() count
  /// @param stop ends the work as soon as it is set; nullptr: none
  WorkLimit(Clock::time_point start, double seconds, std::size_t memory_bytes, const std::atomic<bool>* stop)
      : start_(start), seconds_(seconds), stop_(stop), memory_(memory_bytes) {
    allowShare(1.0);
  }

  /// Sets the deadline of the next stages to a share of the whole time. A stage may go on after an earlier
  /// one ran out.
  void allowShare(double share) {
    is_timed_ = share * seconds_ < kLongest;
    if (is_timed_)
      deadline_ = start_ + std::chrono::duration_cast<Clock::duration>(Duration(share * seconds_));
    is_over_ = false;
    until_look_ = 0;
  }

  /// Returns whether the work has to end: the deadline has passed or the stop flag is set.
  bool isOver() {
    if (is_over_ || (!is_timed_ && stop_ == nullptr)) return is_over_;
    const bool is_stopped = stop_ != nullptr && stop_->load(std::memory_order_relaxed);
    if (!is_stopped && !(is_timed_ && Clock::now() >= deadline_)) return false;
    time_refused_ = is_over_ = true;
    return true;
  }

  /// The same for loops with steps below a microsecond: only every 32nd call checks.
  bool isOverNow() {
    if (is_over_ || (!is_timed_ && stop_ == nullptr)) return is_over_;
    if (until_look_-- > 0) return false;
    until_look_ = kCallsBetweenLooks;
    return isOver();
  }

  /// Returns whether `more` elements may be added. Counts what the growth takes and grows at once.
  template <typename T>
  bool makeRoom(std::vector<T>& buffer, std::size_t more = 1) {
    const std::size_t needed = buffer.size() + more;
    if (needed <= buffer.capacity()) return true;
    const std::size_t before = buffer.capacity();
    const std::size_t grown = std::max(needed, 2 * before);
    if (!takeMemory(grown * sizeof(T))) return false;
    buffer.reserve(grown);
    returnMemory(before * sizeof(T));  // the old elements go when the new ones are in place
    return true;
  }

  /// Counts memory as taken, or refuses it.
  bool takeMemory(std::size_t bytes) {
    if (!hasMemory(bytes)) {
      memory_refused_ = true;
      return false;
    }
    taken_ += bytes;
    return true;
  }
  void returnMemory(std::size_t bytes) { taken_ -= std::min(bytes, taken_); }
  /// Counts the memory of buffers from earlier solves.
  void setTaken(std::size_t bytes) { taken_ = bytes; }
  std::size_t taken() const { return taken_; }
  /// Returns whether takeMemory() would succeed; counts nothing.
  bool hasMemory(std::size_t bytes) const { return bytes <= memory_ && taken_ <= memory_ - bytes; }

  /// The same time for a part that another thread may do, in buffers that have all the memory they get.
  WorkLimit withoutMemory() const {
    WorkLimit part = *this;
    part.memory_ = 0;
    return part;
  }

  /// Says that the time is likely to suffice. The deadline holds, but isTimed() is false: stages take the
  /// order that is fastest when nothing ends them.
  void expectEnough() { expects_enough_ = true; }
  /// Returns whether to be ready for an end at any moment.
  bool isTimed() const { return is_timed_ && !expects_enough_; }
  /// Returns `seconds` as a share of the whole time; 0 without a deadline.
  double shareOf(double seconds) const { return seconds_ < kLongest ? seconds / seconds_ : 0.0; }
  /// Returns whether anything was refused, so that the results are incomplete.
  bool hasRefusedTime() const { return time_refused_; }
  bool hasRefusedMemory() const { return memory_refused_; }
  bool hasRefused() const { return time_refused_ || memory_refused_; }

 private:
  using Duration = std::chrono::duration<double>;
  static constexpr std::uint32_t kCallsBetweenLooks = 31;
  static constexpr double kLongest = 1e9;  ///< s that the clock can count from now on

  Clock::time_point start_;
  Clock::time_point deadline_;
  double seconds_ = std::numeric_limits<double>::infinity();
  const std::atomic<bool>* stop_ = nullptr;
  std::size_t memory_ = std::numeric_limits<std::size_t>::max();
  std::size_t taken_ = 0;
  std::uint32_t until_look_ = 0;
  bool is_timed_ = false;
  bool expects_enough_ = false;
  bool is_over_ = false;
  bool time_refused_ = false;
  bool memory_refused_ = false;
};

/// Returns the memory taken inside a scope at its end, for buffers that are freed there.
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
