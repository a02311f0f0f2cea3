#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace concave_distance::benchmark {

inline double microsecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

/// Milliseconds that `act` takes.
template <typename Act>
double millisecondsOf(const Act& act) {
  const auto start = std::chrono::steady_clock::now();
  act();
  return 1e-3 * microsecondsSince(start);
}

/// The instant so many seconds from now.
inline std::chrono::steady_clock::time_point instantIn(double seconds) {
  using Clock = std::chrono::steady_clock;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Microseconds of the fastest of as many runs as fit into a third of a second.
template <typename Run>
double fastest(const Run& run) {
  double best = std::numeric_limits<double>::infinity();
  double total = 0.0;
  for (int i = 0; i < 1000 && (total < 3e5 || i < 3); ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    const double taken = microsecondsSince(start);
    best = std::min(best, taken);
    total += taken;
  }
  return best;
}

/// Processor time of the calling thread, microseconds: what a single-threaded method costs on a machine that
/// others use, too.
inline double processorMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Measures what a query takes on a core of its own, microseconds: the lesser of wall time and of the
/// thread's processor time. On a machine that others use, too, long queries are interrupted, which the latter
/// leaves out; of short ones it says too much, since to read it takes a third of a microsecond.
class QueryClock {
 public:
  QueryClock() : processor_(processorMicroseconds()), wall_(std::chrono::steady_clock::now()) {}

  double microseconds() const {
    const double wall = microsecondsSince(wall_);
    return std::min(wall, processorMicroseconds() - processor_);
  }

 private:
  double processor_;
  std::chrono::steady_clock::time_point wall_;
};

}  // namespace concave_distance::benchmark
