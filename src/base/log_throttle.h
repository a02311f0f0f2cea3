#pragma once

#include <chrono>
#include <map>
#include <string>

namespace concave_distance {

/// Limits log messages: one per subject in five seconds of wall time, and one per second of all subjects. Not
/// thread-safe.
class LogThrottle {
 public:
  bool isDue(const std::string& subject);

 private:
  using Time = std::chrono::steady_clock::time_point;
  std::map<std::string, Time> last_of_subject_;
  Time last_ = Time::min();
};

/// The text with every control character as \xNN, cut after 80 characters: safe for a log and a terminal.
std::string printable(const std::string& text);

}  // namespace concave_distance
