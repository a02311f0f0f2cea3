#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace concave_distance::detail {

/// A moment of a motion: a segment between two waypoints, and the share of it that has passed.
struct MotionMoment {
  std::size_t segment = 0;
  double share = 0.0;  ///< 0 to 1
};

/// One number over a motion, a polynomial of each segment's share. Rates are by that share, not by seconds.
/// Moments as one number: that of the segment plus the share, which is the waypoint's number at a waypoint.
class MotionCurve {
 public:
  static constexpr std::size_t kCoefficients = 6;
  using Coefficients = std::array<double, kCoefficients>;  ///< lowest power first

  /// Straight lines. @param values one for each waypoint, at least one
  static MotionCurve straight(const std::vector<double>& values);
  /// @param degree of all segments, at most 5
  MotionCurve(std::vector<Coefficients> segments, std::size_t degree);

  /// Returns factor times the curve, plus offset.
  MotionCurve scaled(double factor, double offset) const;

  double value(MotionMoment at) const;
  double rate(MotionMoment at) const;

  struct Bounds {
    double rate = 0.0;          ///< no larger magnitude of the rate
    double acceleration = 0.0;  ///< ... of its rate
    double variation = 0.0;     ///< no longer way, back and forth together
  };
  /// Bounds of a part of one segment, from the Bernstein coefficients of the rates.
  Bounds bounds(std::size_t segment, double from, double to) const;
  /// Bounds the way between two moments, which may be in different segments.
  double variation(double from, double to) const;
  bool isStraight() const { return degree_ == 1; }
  /// No value is larger, nor a term that it is the sum of.
  double magnitude() const { return magnitude_; }
  std::size_t segmentCount() const { return segments_.size(); }

 private:
  std::vector<Coefficients> segments_;
  std::size_t degree_;
  std::vector<double> variation_before_;  ///< of all segments before each, and the sum
  double magnitude_ = 0.0;
};

/// @param segments of the motion, at least 1
MotionMoment momentAt(double moment, std::size_t segments);

}  // namespace concave_distance::detail
