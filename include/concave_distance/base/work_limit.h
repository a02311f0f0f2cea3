#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace concave_distance {

/// Limits the time of a solve and the facet pairs that each of its stages may hold. All stages share one
/// limit and ask it in every loop that can be long; a refusal is remembered until the solve ends. Without
/// deadline and stop flag, asking costs a comparison; reading the clock costs about 25 ns.
class WorkLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// No limit.
  WorkLimit() = default;

  /// @param seconds from `start`; infinite: no deadline
  /// @param facet_pairs that a stage may hold at once (admits())
  /// @param stop ends the work as soon as it is set; nullptr: none
  WorkLimit(Clock::time_point start, double seconds, std::size_t facet_pairs, const std::atomic<bool>* stop)
      : start_(start), seconds_(seconds), stop_(stop), facet_pairs_(facet_pairs) {
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

  /// Returns whether a stage may hold so many facet pairs at once, or pairs of boxes or of cones, each of
  /// which stands for many.
  bool admits(std::size_t facet_pairs) {
    if (facet_pairs <= facet_pairs_) return true;
    pairs_refused_ = true;
    return false;
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
  bool hasRefusedPairs() const { return pairs_refused_; }
  bool hasRefused() const { return time_refused_ || pairs_refused_; }

 private:
  using Duration = std::chrono::duration<double>;
  static constexpr std::uint32_t kCallsBetweenLooks = 31;
  static constexpr double kLongest = 1e9;  ///< s that the clock can count from now on

  Clock::time_point start_;
  Clock::time_point deadline_;
  double seconds_ = std::numeric_limits<double>::infinity();
  const std::atomic<bool>* stop_ = nullptr;
  std::size_t facet_pairs_ = std::numeric_limits<std::size_t>::max();
  std::uint32_t until_look_ = 0;
  bool is_timed_ = false;
  bool expects_enough_ = false;
  bool is_over_ = false;
  bool time_refused_ = false;
  bool pairs_refused_ = false;
};

}  // namespace concave_distance
