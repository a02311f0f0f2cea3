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

/// The point of the segment (from, to) that is nearest to `point`.
Vector2d nearestOnSegment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d edge = to - from;
  const double squared_length = edge.squaredNorm();
  if (!(squared_length > 0.0)) return from;
  const double along = edge.dot(point - from) / squared_length;
  if (along <= 0.0) return from;
  if (along >= 1.0) return to;
  return from + along * edge;
}

void appendCornersNear(const PlanarFeature& feature, const PlanarFeature& other, double reach,
                       PlanarPoints& points) {
  for (std::size_t i = 0; i < feature.count; ++i) {
    const Vector2d nearest = nearestIn(other.corners, other.count, feature.corners[i]);
    if ((nearest - feature.corners[i]).squaredNorm() <= reach * reach) points.push_back(feature.corners[i]);
  }
}

void appendCrossing(const Vector2d& from_a, const Vector2d& to_a, const Vector2d& from_b,
                    const Vector2d& to_b, PlanarPoints& points) {
  const Vector2d u = to_a - from_a;
  const Vector2d v = to_b - from_b;
  const double determinant = turn(u, v);
  // Side by side, if at all: their ends are within reach. Where they cross would be what rounding makes it.
  constexpr double kParallel = 1e-12;
  if (determinant * determinant <= kParallel * kParallel * u.squaredNorm() * v.squaredNorm()) return;
  const double along_a = turn(from_b - from_a, v) / determinant;
  const double along_b = turn(from_b - from_a, u) / determinant;
  if (along_a < 0.0 || along_a > 1.0 || along_b < 0.0 || along_b > 1.0) return;
  points.push_back(from_a + along_a * u);
}

std::size_t edgeCount(const PlanarFeature& feature) {
  return feature.count == 3 ? 3 : (feature.count == 2 ? 1 : 0);
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

void appendOverlap(const PlanarFeature& a, const PlanarFeature& b, double reach, PlanarPoints& points) {
  if (a.count == 0 || b.count == 0) return;
  appendCornersNear(a, b, reach, points);
  appendCornersNear(b, a, reach, points);
  for (std::size_t i = 0; i < edgeCount(a); ++i) {
    for (std::size_t j = 0; j < edgeCount(b); ++j) {
      appendCrossing(a.corners[i], a.corners[(i + 1) % 3], b.corners[j], b.corners[(j + 1) % 3], points);
    }
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
