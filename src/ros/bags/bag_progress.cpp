#include "bag_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr double kPeriod = 0.5;        // s
constexpr double kLeastLength = 1e-9;  // s; one message has no length

}  // namespace

BagProgress::BagProgress(ros::Time begin, ros::Time end)
    : begin_(begin), end_(end), is_terminal_(isatty(STDERR_FILENO) != 0) {}

double BagProgress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

double BagProgress::realTimeFactor(ros::Time now) const {
  return secondsBetween(begin_, now) / std::max(seconds(), kLeastLength);
}

bool BagProgress::show(ros::Time now) {
  if (std::chrono::duration<double>(Clock::now() - shown_).count() < kPeriod) return false;
  shown_ = Clock::now();
  if (!is_terminal_) return true;
  const double length = secondsBetween(begin_, end_);
  const double done = secondsBetween(begin_, now);
  std::fprintf(stderr, "\r%5.1f %%, %.1f of %.1f s, real-time factor %.2f ",
               100.0 * done / std::max(length, kLeastLength), done, length, realTimeFactor(now));
  std::fflush(stderr);
  has_line_ = true;
  return true;
}

void BagProgress::finish() {
  if (has_line_) std::fputc('\n', stderr);
  has_line_ = false;
}

}  // namespace concave_distance
