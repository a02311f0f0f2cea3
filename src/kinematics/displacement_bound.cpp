#include "displacement_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// All sums here are of less than a thousand terms of one sign.
constexpr double kRounding = 0x1.0p-42;
constexpr double kRoundedUp = 1.0 + kRounding;

/// The velocity field of B against A, base frame.
struct Twist {
  Vector3d turn = Vector3d::Zero();
  Vector3d slide = Vector3d::Zero();  ///< at the base's origin

  double fastest(const BoxCorners& points) const {
    const auto x = slide.x() + turn.y() * points.col(2) - turn.z() * points.col(1);
    const auto y = slide.y() + turn.z() * points.col(0) - turn.x() * points.col(2);
    const auto z = slide.z() + turn.x() * points.col(1) - turn.y() * points.col(0);
    return std::sqrt((x.square() + y.square() + z.square()).maxCoeff());
  }
};

Twist twistOf(const MotionPaths& paths, const RelativePath& path, const RelativePose& pose) {
  Twist twist;
  for (std::size_t place = 0; place < path.elements().size(); ++place) {
    const PathElement& element = paths.elements[path.elements()[place]];
    const RelativePose::Axis& axis = pose.axes[place];
    const double side = place < path.countOfA() ? -1.0 : 1.0;
    const auto rate = [&](std::size_t k) { return side * paths.curves[element.curve + k].rate(pose.at); };
    if (element.isTurning()) {
      twist.turn += rate(0) * axis.direction;
      twist.slide -= rate(0) * axis.direction.cross(axis.origin);
      continue;
    }
    twist.slide += rate(0) * axis.slides.col(0);
    if (element.kind != PathElement::Kind::Shift) continue;
    twist.slide += rate(1) * axis.slides.col(1) + rate(2) * axis.slides.col(2);
  }
  return twist;
}

BoxCorners placed(const Eigen::Isometry3d& pose, const BoxCorners& corners) {
  BoxCorners points;
  for (Eigen::Index k = 0; k < 3; ++k) {
    points.col(k) =
        pose(k, 0) * corners.col(0) + pose(k, 1) * corners.col(1) + pose(k, 2) * corners.col(2) + pose(k, 3);
  }
  return points;
}

/// Returns how far the farthest point is from an axis, or from its origin.
double farthestFrom(const RelativePose::Axis& axis, bool is_axis, const BoxCorners& points) {
  const Eigen::Array<double, 8, 1> x = points.col(0) - axis.origin.x();
  const Eigen::Array<double, 8, 1> y = points.col(1) - axis.origin.y();
  const Eigen::Array<double, 8, 1> z = points.col(2) - axis.origin.z();
  const Eigen::Array<double, 8, 1> squared = x.square() + y.square() + z.square();
  if (!is_axis) return std::sqrt(squared.maxCoeff());
  const auto along = axis.direction.x() * x + axis.direction.y() * y + axis.direction.z() * z;
  // The difference is off by a few units of rounding of the squares.
  return std::sqrt((squared * kRoundedUp - along.square()).maxCoeff());
}

}  // namespace

BoxCorners cornersOf(const BodyBounds& bounds) {
  BoxCorners corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Vector3d sides((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0, (i & 4U) != 0 ? 1.0 : -1.0);
    corners.row(i) = (bounds.centre + sides.cwiseProduct(bounds.half_extents)).transpose().array();
  }
  return corners;
}

double DisplacementBound::shareOf(double metres) const {
  if (!(metres > 0.0)) return 0.0;
  const double root = std::sqrt(speed * speed + 2.0 * acceleration * metres);
  const double sum = speed + root;
  return sum > 0.0 ? (1.0 - 0x1.0p-40) * 2.0 * metres / sum : std::numeric_limits<double>::infinity();
}

void MotionSpan::set(const MotionPaths& paths, const RelativePath& path, double from, double to) {
  paths_ = &paths;
  path_ = &path;
  from_ = from;
  to_ = to;
  segment_ = momentAt(from, paths.segmentCount()).segment;
  is_in_one_segment_ = to - static_cast<double>(segment_) <= 1.0;
  elements_.clear();
  turns_ = 0.0;
  for (const std::size_t place : path.elements()) {
    elements_.push_back(spanOf(paths.elements[place]));
    if (paths.elements[place].isTurning()) turns_ += elements_.back().rate;
  }
}

MotionMoment MotionSpan::momentOf(double end) const {
  if (!is_in_one_segment_) return momentAt(end, paths_->segmentCount());
  return {segment_, end - static_cast<double>(segment_)};
}

MotionSpan::ElementSpan MotionSpan::spanOf(const PathElement& element) const {
  const std::size_t count = element.kind == PathElement::Kind::Shift ? 3 : 1;
  Vector3d rate = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();
  double way = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const MotionCurve& curve = paths_->curves[element.curve + k];
    if (!is_in_one_segment_) {
      way += curve.variation(from_, to_);
      continue;
    }
    const auto start = static_cast<double>(segment_);
    const MotionCurve::Bounds bounds = curve.bounds(segment_, from_ - start, to_ - start);
    rate[static_cast<Eigen::Index>(k)] = bounds.rate;
    acceleration[static_cast<Eigen::Index>(k)] = bounds.acceleration;
    way += bounds.variation;
  }
  if (is_in_one_segment_) way = std::min(way, (to_ - from_) * rate.norm());
  return {rate.norm(), acceleration.norm(), way};
}

// Seen from A, a point x of B moves by the elements of the path, in their order from A to B. Its rate by a
// turn about an axis is its distance from the axis, and that changes only by what is between the axis and B:
// so the elements are taken from B's end. The second derivative by two elements is the rate by the one nearer
// to B, turned by the other if that turns. The view from B is the same from A's end.
DisplacementBound MotionSpan::seenFrom(bool is_from_a, const RelativePose& pose,
                                       const BoxCorners& corners) const {
  const BoxCorners points = placed(is_from_a ? pose.base_from_b : pose.base_from_a, corners);
  DisplacementBound bound;
  bound.is_from_a = is_from_a;
  double turns_beyond = turns_;
  double terms = 0.0;  // of the sums below, for their rounding
  const std::size_t count = elements_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = is_from_a ? count - 1 - k : k;
    const PathElement& element = paths_->elements[path_->elements()[place]];
    const ElementSpan& span = elements_[place];
    double reach = 1.0;
    terms += span.rate;
    double turning = 2.0 * turns_beyond;
    if (element.isTurning()) {
      // The axis of a slerp is another in each segment.
      const bool has_one_axis = element.kind == PathElement::Kind::Turn || is_in_one_segment_;
      reach = bound.way + farthestFrom(pose.axes[place], has_one_axis, points);
      turns_beyond = std::max(0.0, turns_beyond - span.rate);
      turning = span.rate + 2.0 * turns_beyond + kRounding * turns_;
      terms += span.rate * (reach + 2.0 * pose.axes[place].origin.norm());
    }
    bound.acceleration += reach * (span.rate * turning + span.acceleration);
    bound.way += reach * span.way;
  }
  bound.way *= kRoundedUp;
  if (is_in_one_segment_) {
    bound.speed = kRoundedUp * twistOf(*paths_, *path_, pose).fastest(points) + kRounding * terms;
    bound.acceleration *= kRoundedUp;
  } else {
    bound.acceleration = std::numeric_limits<double>::infinity();
  }
  return bound;
}

DisplacementBound MotionSpan::from(const RelativePose& pose, const BoxCorners& corners_a,
                                   const BoxCorners& corners_b) const {
  const DisplacementBound from_a = seenFrom(true, pose, corners_b);
  const DisplacementBound from_b = seenFrom(false, pose, corners_a);
  const auto whole = [&](const DisplacementBound& bound) {
    return is_in_one_segment_ ? std::min(bound.way, bound.after(to_ - from_)) : bound.way;
  };
  return whole(from_b) < whole(from_a) ? from_b : from_a;
}

}  // namespace concave_distance::detail
