#include "round_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "mesh/surface/round_geometry.h"
#include "round_lines.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

// Two edges end next to each other where their corner is on the solid's surface: an arc between them that
// seems to run backwards by less than this is none.
constexpr double kNoArc = 1e-13;

bool comesFirst(const Vector3d& l, const Vector3d& r) {
  return std::lexicographical_compare(l.data(), l.data() + 3, r.data(), r.data() + 3);
}

}  // namespace

LowestPoint lowestOnEdge(const RoundShape& shape, const Vector3d& from, const Vector3d& to) {
  return comesFirst(from, to) ? lowestOnSegment(shape, from, to) : lowestOnSegment(shape, to, from);
}

void RoundOutline::find(const RoundShape& shape, const TrianglePoints& triangle, const Vector3d& normal,
                        const Vector3d& centre) {
  shape_ = &shape;
  triangle_ = triangle;
  normal_ = normal;
  centre_ = centre;
  axis_u_ = normal_.unitOrthogonal();
  axis_v_ = normal_.cross(axis_u_);
  findStraights();
  findArcs();
}

// The signed distance is convex along an edge: below 0 between two crossings at most.
void RoundOutline::findStraights() {
  straights_.clear();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = triangle_[k];
    const Vector3d& to = triangle_[(k + 1) % 3];
    const LowestPoint lowest = lowestOnEdge(*shape_, from, to);
    if (lowest.value >= 0.0) continue;
    const auto end = [&](const Vector3d& corner) {
      const Vector3d way = corner - lowest.point;
      const double length = way.norm();
      if (signedDistance(*shape_, corner) <= 0.0 || !(length > 0.0)) return corner;
      return Vector3d(lowest.point + wayOut(*shape_, lowest.point, way / length, length) / length * way);
    };
    const Straight straight{end(from), end(to)};
    if (straight.from != straight.to) straights_.push_back(straight);
  }
}

/// From the end of each straight piece to the next one. All angles together are a whole turn, of which one
/// piece takes half at most.
void RoundOutline::findArcs() {
  arcs_.clear();
  if (straights_.empty()) {
    const Vector3d start = border(0.0);
    return addArc(0.0, 2.0 * kPi, start, start);
  }
  for (std::size_t k = 0; k < straights_.size(); ++k) {
    const Vector3d& end = straights_[k].to;
    const Vector3d& next = straights_[(k + 1) % straights_.size()].from;
    if (end == next) continue;
    double width = angleBetween(end, next);
    if (straights_.size() == 1) {
      width = 2.0 * kPi - std::abs(angleBetween(next, end));
    } else if (width < -kNoArc) {
      width += 2.0 * kPi;
    }
    addArc(angleOf(end), std::max(0.0, width), end, next);
  }
}

/// Cut where the solid's surface changes from one piece to another.
void RoundOutline::addArc(double from, double width, const Vector3d& start, const Vector3d& end) {
  findBends(from, width);
  Vector3d before = start;
  double angle = 0.0;
  for (std::size_t b = 0; b < bend_count_; ++b) {
    const Vector3d at = border(from + bends_[b]);
    arcs_.push_back({from + angle, from + bends_[b], before, at});
    before = at;
    angle = bends_[b];
  }
  arcs_.push_back({from + angle, from + width, before, end});
}

/// Angles beyond `from` at which the rims of the solid's pieces cross the triangle's plane.
void RoundOutline::findBends(double from, double width) {
  bend_count_ = 0;
  const double across = std::hypot(normal_.x(), normal_.y());
  if (!hasSide(*shape_) || !(across > 0.0)) return;
  for (const double end : {-shape_->half_length, shape_->half_length}) {
    const double level = (normal_.dot(centre_) - normal_.z() * end) / across;
    const double half_squared = shape_->radius * shape_->radius - level * level;
    if (half_squared <= 0.0) continue;
    const Vector3d out(normal_.x() / across, normal_.y() / across, 0.0);
    const Vector3d side(-out.y(), out.x(), 0.0);
    for (const double half : {-std::sqrt(half_squared), std::sqrt(half_squared)}) {
      double angle = angleOf(level * out + half * side + end * Vector3d::UnitZ()) - from;
      while (angle <= 0.0) angle += 2.0 * kPi;
      while (angle > 2.0 * kPi) angle -= 2.0 * kPi;
      if (angle < width) bends_[bend_count_++] = angle;
    }
  }
  std::sort(bends_.begin(), bends_.begin() + static_cast<std::ptrdiff_t>(bend_count_));
}

double RoundOutline::angleOf(const Vector3d& point) const {
  const Vector3d way = point - centre_;
  return std::atan2(way.dot(axis_v_), way.dot(axis_u_));
}

/// Between -pi and pi.
double RoundOutline::angleBetween(const Vector3d& from, const Vector3d& to) const {
  const Vector3d l = from - centre_;
  const Vector3d r = to - centre_;
  return std::atan2(l.cross(r).dot(normal_), l.dot(r));
}

/// Returns how far the triangle goes from the centre.
double RoundOutline::edgeWay(const Vector3d& direction) const {
  double way = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d outward = (triangle_[(k + 1) % 3] - triangle_[k]).cross(normal_);
    const double rate = outward.dot(direction);
    if (rate > 0.0) way = std::min(way, std::max(0.0, outward.dot(triangle_[k] - centre_) / rate));
  }
  return way;
}

Vector3d RoundOutline::border(double angle) const {
  return towards(std::cos(angle) * axis_u_ + std::sin(angle) * axis_v_);
}

Vector3d RoundOutline::towards(const Vector3d& direction) const {
  return centre_ + wayOut(*shape_, centre_, direction, std::min(2.0 * reachOf(*shape_), edgeWay(direction))) *
                       direction;
}

}  // namespace concave_distance::detail
