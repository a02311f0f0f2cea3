#include "bare_timer.h"

#include <algorithm>
#include <ctime>

namespace concave_distance {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * kNanoseconds + time.tv_nsec;
}

}  // namespace

BareTimer::BareTimer(double period) : thread_([this, period] { run(period); }) {}

BareTimer::~BareTimer() {
  stop();
}

void BareTimer::stop() {
  running_ = false;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void BareTimer::run(double period) {
  const auto step = static_cast<std::int64_t>(period * static_cast<double>(kNanoseconds));
  std::int64_t due = now() + step;
  while (running_) {
    const timespec until{due / kNanoseconds, due % kNanoseconds};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    ++cycles_;
    const std::int64_t woken = now();
    late_ += woken > due + step ? 1 : 0;
    due = std::max(due + step, woken);  // as roscpp's timers do
  }
}

}  // namespace concave_distance
