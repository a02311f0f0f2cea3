#pragma once

#include <cstddef>
#include <optional>

#include "clearance_pair.h"

namespace concave_distance::detail {

/// A span of a pair's motion between two samples, with a bound of all distances in it. The end of the motion
/// may not be sampled yet; `lower` is then minus infinity.
struct ClearanceGap {
  std::size_t pair = 0;
  ClearanceSample left;
  ClearanceSample right;
  double lower = 0.0;    ///< metres, proven for the span; may be negative where nothing is
  double weakest = 0.0;  ///< the moment at which the ends prove least, between them
  double way = 0.0;      ///< metres that any point moves in the span, at most
  DisplacementBound from_left;
  DisplacementBound from_right;

  double bound() const { return lower > 0.0 ? lower : 0.0; }
  /// Says that another sample inside would prove nothing more: the span is a moment, its weakest moment is an
  /// end, or nothing moves farther than `least_way` in it, metres.
  bool isUndivided(double least_way) const;
  bool isCertified() const { return left.is_certified && right.is_certified; }
};

/// Bounds the distances between two samples of a pair.
ClearanceGap gapBetween(const MotionPaths& paths, const ClearancePair& pair, std::size_t index,
                        const ClearanceSample& left, const ClearanceSample& right,
                        ClearanceWorkspace& workspace);

/// Returns the middle of what the ends do not prove to be at least as far as `threshold`, metres; empty where
/// there is nothing left.
std::optional<double> middleBelow(const MotionPaths& paths, const ClearanceGap& gap, double threshold);

/// Returns the waypoint inside a span of several segments that is nearest to a moment, or the moment itself.
double splitAt(const MotionPaths& paths, double from, double to, double wanted);

/// Samples a pair inside a gap or at one of its ends.
ClearanceSample sampleIn(const MotionPaths& paths, const ClearancePair& pair, const ClearanceGap& gap,
                         double moment, const SampleRequest& request, ClearanceWorkspace& workspace,
                         WorkLimit& limit);

}  // namespace concave_distance::detail
