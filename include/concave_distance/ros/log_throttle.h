#pragma once

#include <chrono>
#include <map>
#include <string>

namespace concave_distance {

/// Which messages may be logged now: of each subject one in five seconds of wall time, and of all together
/// one a second. Not thread-safe.
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
