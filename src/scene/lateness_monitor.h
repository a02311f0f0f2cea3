#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace concave_distance {

/// The count of cycles at one time.
struct LatenessSample {
  double wall = 0.0;         ///< s
  double ros_time = 0.0;     ///< s; simulated time may stand still
  std::uint64_t cycles = 0;  ///< finished since the node began
  std::uint64_t late = 0;    ///< of these
  double wanted_rate = 0.0;  ///< Hz, of ROS time
};

/// Reports once when cycles become late, again when the rate halves or doubles, and when they are on time
/// again. Looks at spans of some seconds and reports what several in a row agree on, so that neither a slow
/// cycle nor a start is reported. A span in which the clock starts or jumps does not count.
class LatenessMonitor {
 public:
  struct News {
    bool is_warning = true;
    std::string text;  ///< what happened, without a remedy
  };
  /// To be called a few times a second.
  std::optional<News> update(const LatenessSample& sample);
  /// Forgets earlier samples, e.g. for another scene or rate.
  void restart();
  bool isLate() const { return reported_rate_.has_value(); }

 private:
  bool clockJumped(const LatenessSample& sample) const;
  std::optional<News> judge(double rate, double late_share, double wanted_rate);

  std::optional<LatenessSample> span_start_;
  std::optional<LatenessSample> last_;
  double last_step_ = 0.0;               ///< s of ROS time, between the last two samples
  std::optional<double> reported_rate_;  ///< Hz, of the last warning; empty: on time
  int good_spans_ = 0;                   ///< in a row
  int late_spans_ = 0;                   ///< in a row
};

}  // namespace concave_distance
