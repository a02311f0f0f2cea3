#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace concave_distance::detail {

/// Measures how fast rows come nearer, from their values in one cycle and the last.
class ClosingMeter {
 public:
  void reset() { samples_.clear(); }
  /// Begins the rows of one cycle. @param time seconds, as of their poses
  void begin(std::size_t slots, double time);
  /// Returns m/s, positive when approaching; NaN for a row that is new in its slot and where the time has
  /// not advanced. @param age as of ConstraintRow
  double measure(std::size_t slot, std::uint64_t niche, std::uint64_t age, double value);

 private:
  struct Sample {
    bool is_used = false;
    std::uint64_t niche = 0;
    std::uint64_t age = 0;
    double value = 0.0;
    double time = 0.0;
    double speed = 0.0;
  };
  std::vector<Sample> samples_;  ///< by slot
  double time_ = 0.0;
};

}  // namespace concave_distance::detail
