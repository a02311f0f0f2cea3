#include "lateness_monitor.h"

#include <cstdio>

namespace concave_distance {
namespace {

constexpr double kSpan = 5.0;       // s of wall time
constexpr double kRateShare = 0.9;  // of the wanted rate; less is late
constexpr double kLateShare = 0.1;  // of the cycles; more is late
constexpr double kMuchMore = 2.0;   // factor of the rate that is reported again
constexpr int kGoodSpans = 2;       // on time in a row before it is reported
constexpr int kLateSpans = 3;       // late in a row: a start may take as long as one of them, in two
// A step of ROS time is a jump when it is longer than this and than some times the step before: simulated
// time may run fast, but it does not suddenly run much faster.
constexpr double kLongStep = 1.0;  // s
constexpr double kMuchLonger = 4.0;

std::string describe(double rate, double late_share, double wanted_rate) {
  char text[160];
  if (rate <= 0.0) {
    std::snprintf(text, sizeof text, "no cycle has finished for %.0f s (%.3g a second are wanted)",
                  kLateSpans * kSpan, wanted_rate);
  } else {
    std::snprintf(text, sizeof text, "%.3g cycles a second instead of %.3g, %.0f %% of them late", rate,
                  wanted_rate, 100.0 * late_share);
  }
  return text;
}

}  // namespace

void LatenessMonitor::restart() {
  span_start_.reset();
  last_.reset();
  reported_rate_.reset();
  good_spans_ = late_spans_ = 0;
}

bool LatenessMonitor::clockJumped(const LatenessSample& sample) const {
  const double step = sample.ros_time - last_->ros_time;
  return last_->ros_time == 0.0 || step < 0.0 || (step > kLongStep && step > kMuchLonger * last_step_);
}

std::optional<LatenessMonitor::News> LatenessMonitor::update(const LatenessSample& sample) {
  const bool begins = !last_ || clockJumped(sample) || sample.wanted_rate != last_->wanted_rate;
  last_step_ = last_ ? sample.ros_time - last_->ros_time : 0.0;
  last_ = sample;
  if (begins) {
    span_start_ = sample;
    return std::nullopt;
  }
  if (sample.wall - span_start_->wall < kSpan) {
    return std::nullopt;
  }
  const LatenessSample start = *span_start_;
  span_start_ = sample;
  const double passed = sample.ros_time - start.ros_time;
  if (!(passed * sample.wanted_rate > 1.0)) {
    return std::nullopt;  // the clock stands still, or no cycle was due
  }
  const auto cycles = static_cast<double>(sample.cycles - start.cycles);
  const auto late = static_cast<double>(sample.late - start.late);
  return judge(cycles / passed, cycles > 0.0 ? late / cycles : 1.0, sample.wanted_rate);
}

std::optional<LatenessMonitor::News> LatenessMonitor::judge(double rate, double late_share,
                                                            double wanted_rate) {
  const bool is_late = rate < kRateShare * wanted_rate || late_share > kLateShare;
  good_spans_ = is_late ? 0 : good_spans_ + 1;
  late_spans_ = is_late ? late_spans_ + 1 : 0;
  if (!is_late) {
    if (!reported_rate_ || good_spans_ < kGoodSpans) {
      return std::nullopt;
    }
    reported_rate_.reset();
    return News{false, "cycles are on time again: " + describe(rate, late_share, wanted_rate)};
  }
  if (late_spans_ < kLateSpans) return std::nullopt;
  if (!reported_rate_) {
    reported_rate_ = rate;
    return News{true, "cycles are late: " + describe(rate, late_share, wanted_rate)};
  }
  if (rate < *reported_rate_ / kMuchMore) {
    reported_rate_ = rate;
    return News{true, "cycles are even later: " + describe(rate, late_share, wanted_rate)};
  }
  if (rate > *reported_rate_ * kMuchMore) {
    reported_rate_ = rate;
    return News{false, "cycles are still late, but less: " + describe(rate, late_share, wanted_rate)};
  }
  return std::nullopt;
}

}  // namespace concave_distance
