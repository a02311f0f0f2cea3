#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance {

/// Mean and largest of a series.
struct Series {
  std::uint64_t count = 0;
  double sum = 0.0;
  double largest = -std::numeric_limits<double>::infinity();
  void add(double value);
  double mean() const;  ///< NaN when nothing was added
};

/// One cycle as the server saw it. Seconds.
struct CycleRecord {
  CycleCounts report;
  double duration = 0.0;             ///< from the timer's call to the last message published
  double cpu = 0.0;                  ///< processor time of all threads that worked on the cycle
  bool late = false;                 ///< ended after the next cycle was due
  Series latency;                    ///< from the transforms' time to the message, of each pair newly solved
  std::uint32_t messages = 0;        ///< pairs turned into messages
  std::uint32_t markers = 0;         ///< drawn or deleted
  std::vector<std::string> failing;  ///< pairs without transforms, each with the reason
};

/// Holds what the diagnostics report of the cycles since they were last published.
struct CycleWindow {
  double seconds = 0.0;  ///< wall time covered
  double running = 0.0;  ///< s for which a cycle had run that had not ended by then; 0: none
  std::uint64_t cycles = 0;
  std::uint64_t late = 0;
  std::uint64_t failed = 0;  ///< cycles ended by an exception
  Series duration;
  Series cpu;
  Series latency;
  CycleCounts total;  ///< of these cycles
  std::uint64_t messages = 0;
  std::uint64_t markers = 0;
  CycleCounts last;                  ///< of the last cycle
  std::vector<std::string> failing;  ///< in the last cycle
};

/// Collects records from the cycle's thread for the diagnostics' thread.
class CycleStatistics {
 public:
  /// A cycle begins, which add() or addFailure() ends. @param wall_seconds as in take()
  void begin(double wall_seconds);
  void add(CycleRecord record);
  void addFailure();
  /// @param wall_seconds now, of a clock that never jumps
  CycleWindow take(double wall_seconds);
  /// Since the start; for long measurements.
  std::uint64_t totalCycles();
  std::uint64_t totalLate();

 private:
  std::mutex mutex_;
  CycleWindow window_;
  double window_start_ = -1.0;
  double cycle_start_ = -1.0;  ///< negative: none is running
  std::uint64_t total_cycles_ = 0;
  std::uint64_t total_late_ = 0;
};

}  // namespace concave_distance
