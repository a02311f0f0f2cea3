#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "concave_distance/scene/broad_phase.h"
#include "relative_path.h"

namespace concave_distance::detail {

/// Holds the corners of a body's box, in its frame: a row for each.
using BoxCorners = Eigen::Array<double, 8, 3>;
BoxCorners cornersOf(const BodyBounds& bounds);

/// Bounds how far any point of one body of a pair comes in the frame of the other, in a span of a motion:
/// after a share s of the span's segment s * speed + s^2 / 2 * acceleration from the end at which it was
/// computed, and `way` in the whole span. Metres, as seen from one of the bodies: the distance changes by no
/// more.
struct DisplacementBound {
  double speed = 0.0;         ///< at this end, of the fastest point; by share of the segment
  double acceleration = 0.0;  ///< infinite where the span is in several segments
  double way = 0.0;
  bool is_from_a = true;  ///< seen from A: what is said of B's points; else of A's, seen from B

  /// Metres after a share of the segment from this end.
  double after(double share) const { return share * (speed + 0.5 * acceleration * share); }
  /// The share after which it is so many metres.
  double shareOf(double metres) const;
};

/// A span of a motion for one pair: what its joints do in it.
class MotionSpan {
 public:
  /// @param from,to moments
  void set(const MotionPaths& paths, const RelativePath& path, double from, double to);

  bool isInOneSegment() const { return is_in_one_segment_; }
  /// An end of the span, seen from the span's segment.
  MotionMoment momentOf(double end) const;
  /// The bound from one end. @param pose at momentOf() that end
  /// @param corners_a,corners_b in the frames of the bodies
  DisplacementBound from(const RelativePose& pose, const BoxCorners& corners_a,
                         const BoxCorners& corners_b) const;

 private:
  /// Bounds what an element of the path does in the span.
  struct ElementSpan {
    double rate = 0.0;          ///< rad or m by share of the segment; nothing where the span has several
    double acceleration = 0.0;  ///< likewise
    double way = 0.0;           ///< rad or m
  };
  ElementSpan spanOf(const PathElement& element) const;
  DisplacementBound seenFrom(bool is_from_a, const RelativePose& pose, const BoxCorners& corners) const;

  const MotionPaths* paths_ = nullptr;
  const RelativePath* path_ = nullptr;
  double from_ = 0.0;
  double to_ = 0.0;
  std::size_t segment_ = 0;
  bool is_in_one_segment_ = true;
  double turns_ = 0.0;  ///< rad by share of the segment, of all elements together
  std::vector<ElementSpan> elements_;
};

}  // namespace concave_distance::detail
