#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace concave_distance {

/// How the cycles do at one time.
struct LatenessSample {
  double wall = 0.0;         ///< s
  double ros_time = 0.0;     ///< s; that of a simulation may stand still
  std::uint64_t cycles = 0;  ///< finished since the node began
  std::uint64_t late = 0;    ///< of them
  double wanted_rate = 0.0;  ///< Hz, of ROS time
};

/// Notices when cycles are late: once when it begins, again when it gets twice as bad or half as bad, and
/// when it is over. Looks at spans of some seconds, so that one slow cycle is no news.
class LatenessMonitor {
 public:
  struct News {
    bool is_warning = true;
    std::string text;  ///< what happens, without a remedy
  };
  /// To be called a few times a second.
  std::optional<News> update(const LatenessSample& sample);
  /// What was before says nothing about what comes (another scene, another rate).
  void restart();
  bool isLate() const { return reported_rate_.has_value(); }

 private:
  std::optional<News> judge(double rate, double late_share, double wanted_rate);

  std::optional<LatenessSample> span_start_;
  std::optional<double> reported_rate_;  ///< Hz, of the last warning; empty: on time
  int good_spans_ = 0;                   ///< one after the other
};

}  // namespace concave_distance
