#pragma once

#include <time.h>

namespace concave_distance::benchmark {

/// Processor time of the calling thread, microseconds: what a single-threaded method costs on a machine that
/// others use, too.
inline double processorMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace concave_distance::benchmark
