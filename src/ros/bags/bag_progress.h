#pragma once

#include <ros/time.h>

#include <chrono>

namespace concave_distance {

/// Shows on standard error how far a replay is, where that is a terminal.
class BagProgress {
 public:
  BagProgress(ros::Time begin, ros::Time end);

  /// Returns true twice a second, when it is time to look after other things too.
  bool show(ros::Time now);
  /// Ends the line.
  void finish();
  /// Returns the seconds of the bag up to here over those that it took; 0 when nothing was played.
  double realTimeFactor(ros::Time now) const;
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  ros::Time begin_;
  ros::Time end_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
  bool is_terminal_;
  bool has_line_ = false;
};

}  // namespace concave_distance
