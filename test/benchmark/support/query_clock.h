#pragma once

#include <algorithm>
#include <chrono>

#include "benchmark/support/processor_time.h"
#include "benchmark/support/stopwatch.h"

namespace concave_distance::benchmark {

/// What a query takes on a core of its own, microseconds: the lesser of wall time and of the thread's
/// processor time. On a machine that others use, too, long queries are interrupted, which the latter leaves
/// out; of short ones it says too much, since to read it takes a third of a microsecond.
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
