#include "planar_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance::detail {
namespace {

using Eigen::Vector2d;

double turn(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vector2d rightOf(const Vector2d& v) {
  return {v.y(), -v.x()};
}

/// Keeps what lies on the side normal . x <= limit (Sutherland and Hodgman 1974).
void clip(const Vector2d& normal, double limit, PlanarPoints& polygon, PlanarPoints& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& from = polygon[i];
    const Vector2d& to = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double height_from = normal.dot(from) - limit;
    const double height_to = normal.dot(to) - limit;
    if (height_from <= 0.0) scratch.push_back(from);
    if ((height_from < 0.0 && height_to > 0.0) || (height_from > 0.0 && height_to < 0.0)) {
      scratch.push_back(from + (height_from / (height_from - height_to)) * (to - from));
    }
  }
  polygon.swap(scratch);
}

void clipToStrip(const Vector2d& direction, double low, double high, PlanarPoints& polygon,
                 PlanarPoints& scratch) {
  clip(direction, high, polygon, scratch);
  clip(-direction, -low, polygon, scratch);
}

void clipToSegment(const Vector2d& from, const Vector2d& to, double slack, PlanarPoints& polygon,
                   PlanarPoints& scratch) {
  const double length = (to - from).norm();
  const Vector2d along = length > 0.0 ? Vector2d((to - from) / length) : Vector2d::UnitX();
  const Vector2d across = rightOf(along);
  clipToStrip(along, along.dot(from) - slack, along.dot(from) + length + slack, polygon, scratch);
  clipToStrip(across, across.dot(from) - slack, across.dot(from) + slack, polygon, scratch);
}

struct Circle {
  Vector2d centre = Vector2d::Zero();
  double squared_radius = -1.0;

  bool holds(const Vector2d& p) const { return (p - centre).squaredNorm() <= squared_radius * (1.0 + 1e-12); }
};

Circle circleOn(const Vector2d& a, const Vector2d& b) {
  const Vector2d centre = 0.5 * (a + b);
  return {centre, std::max((a - centre).squaredNorm(), (b - centre).squaredNorm())};
}

Circle circleThrough(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d ab = b - a;
  const Vector2d ac = c - a;
  const double twice = 2.0 * turn(ab, ac);
  if (twice == 0.0) {  // in line: the two farthest apart
    const Circle candidates[] = {circleOn(a, b), circleOn(a, c), circleOn(b, c)};
    return *std::max_element(
        std::begin(candidates), std::end(candidates),
        [](const Circle& l, const Circle& r) { return l.squared_radius < r.squared_radius; });
  }
  const Vector2d from_a = Vector2d(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                                   ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) /
                          twice;
  return {a + from_a, from_a.squaredNorm()};
}

}  // namespace

Vector2d nearestOnSegment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d edge = to - from;
  const double squared_length = edge.squaredNorm();
  if (!(squared_length > 0.0)) return from;
  const double along = edge.dot(point - from) / squared_length;
  if (along <= 0.0) return from;
  if (along >= 1.0) return to;
  return from + along * edge;
}

void snapOnto(const PlanarFeature& other, double reach, PlanarFeature& feature) {
  for (std::size_t i = 0; i < feature.count; ++i) {
    Vector2d& corner = feature.corners[i];
    double least = reach * reach;
    Vector2d snapped = corner;
    for (std::size_t k = 0; k < other.count; ++k) {
      const Vector2d nearest =
          nearestOnSegment(corner, other.corners[k], other.corners[(k + 1) % other.count]);
      const double squared_distance = (nearest - corner).squaredNorm();
      if (squared_distance <= least) {
        least = squared_distance;
        snapped = nearest;
      }
    }
    corner = snapped;
  }
}

void intersect(const PlanarFeature& feature, const PlanarFeature& other, double slack, PlanarPoints& polygon,
               PlanarPoints& scratch) {
  polygon.assign(feature.corners, feature.corners + feature.count);
  if (other.count == 0) polygon.clear();
  if (other.count == 1) clipToSegment(other.corners[0], other.corners[0], slack, polygon, scratch);
  if (other.count == 2) clipToSegment(other.corners[0], other.corners[1], slack, polygon, scratch);
  if (other.count < 3) return;
  std::size_t longest = 0;
  double length = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = (other.corners[(k + 1) % 3] - other.corners[k]).norm();
    if (edge > length) {
      length = edge;
      longest = k;
    }
  }
  const Vector2d& from = other.corners[longest];
  const Vector2d& to = other.corners[(longest + 1) % 3];
  const double doubled_area = turn(to - from, other.corners[(longest + 2) % 3] - from);
  if (std::abs(doubled_area) <= slack * length) {
    clipToSegment(from, to, slack, polygon, scratch);
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2d edge = other.corners[(k + 1) % 3] - other.corners[k];
    const Vector2d outwards = (doubled_area > 0.0 ? 1.0 : -1.0) * rightOf(edge).normalized();
    clip(outwards, outwards.dot(other.corners[k]) + slack, polygon, scratch);
  }
}

void convexHull(PlanarPoints& points, PlanarPoints& hull) {
  std::sort(points.begin(), points.end(), [](const Vector2d& l, const Vector2d& r) {
    return l.x() != r.x() ? l.x() < r.x() : l.y() < r.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  hull.clear();
  if (points.size() < 3) {
    hull.assign(points.begin(), points.end());
    return;
  }
  const auto add_chain = [&hull](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 &&
             turn(hull.back() - hull[hull.size() - 2], *p - hull[hull.size() - 2]) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();  // the next chain starts there
  };
  add_chain(points.cbegin(), points.cend());
  add_chain(points.crbegin(), points.crend());
}

double diameterOf(const PlanarPoints& hull) {
  double squared = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      squared = std::max(squared, (hull[i] - hull[j]).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

double widthOf(const PlanarPoints& hull) {
  double squared = 0.0;
  Vector2d diagonal = Vector2d::Zero();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      if ((hull[i] - hull[j]).squaredNorm() > squared) {
        diagonal = hull[i] - hull[j];
        squared = diagonal.squaredNorm();
      }
    }
  }
  if (!(squared > 0.0)) return 0.0;
  const Vector2d across = rightOf(diagonal) / std::sqrt(squared);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector2d& p : hull) {
    low = std::min(low, across.dot(p));
    high = std::max(high, across.dot(p));
  }
  return high - low;
}

Vector2d centreOfEnclosingCircle(const PlanarPoints& hull) {
  Circle circle;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (circle.holds(hull[i])) continue;
    circle = {hull[i], 0.0};
    for (std::size_t j = 0; j < i; ++j) {
      if (circle.holds(hull[j])) continue;
      circle = circleOn(hull[i], hull[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!circle.holds(hull[k])) circle = circleThrough(hull[i], hull[j], hull[k]);
      }
    }
  }
  return circle.centre;
}

Vector2d nearestIn(const Vector2d* corners, std::size_t count, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  Vector2d nearest = corners[0];
  bool left = count > 2;
  bool right = count > 2;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d& from = corners[k];
    const Vector2d& to = corners[k + 1 == count ? 0 : k + 1];
    const double side = turn(to - from, point - from);
    left = left && side >= 0.0;
    right = right && side <= 0.0;
    const Vector2d candidate = nearestOnSegment(point, from, to);
    const double squared_distance = (candidate - point).squaredNorm();
    if (squared_distance < least) {
      least = squared_distance;
      nearest = candidate;
    }
  }
  return left != right ? point : nearest;
}

}  // namespace concave_distance::detail
