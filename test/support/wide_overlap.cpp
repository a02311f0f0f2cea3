#include "support/wide_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace concave_distance::test {
namespace {

using Point = ExactVector<long double>;
using Triangle = ExactTriangle<long double>;
using Polygon = std::vector<Point>;

/// Rays from so many pieces of a part look for what lies around it.
constexpr std::size_t kRaysOfPart = 3;

long double lengthOf(const Point& v) {
  return std::sqrt(v.squaredNorm());
}

struct Box {
  explicit Box(const Polygon& points) {
    for (const Point& p : points) {
      const std::array<long double, 3> at{p.x, p.y, p.z};
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], at[i]);
        high[i] = std::max(high[i], at[i]);
      }
    }
  }
  bool isNear(const Box& other, long double tolerance) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (low[i] > other.high[i] + tolerance || other.low[i] > high[i] + tolerance) return false;
    }
    return true;
  }
  std::array<long double, 3> low{INFINITY, INFINITY, INFINITY};
  std::array<long double, 3> high{-INFINITY, -INFINITY, -INFINITY};
};

/// A flat convex piece of a triangle.
struct Piece {
  Polygon corners;
  Box box;
  std::size_t triangle;
  bool is_of_b;
};

bool areNear(const Polygon& l, const Polygon& r, long double tolerance) {
  for (std::size_t i = 2; i < l.size(); ++i) {
    for (std::size_t j = 2; j < r.size(); ++j) {
      const Triangle of_l{l[0], l[i - 1], l[i]};
      const Triangle of_r{r[0], r[j - 1], r[j]};
      if (exactSquaredDistance(of_l, of_r) <= tolerance * tolerance) return true;
    }
  }
  return false;
}

Polygon polygonOf(const Triangle& t) {
  return {t[0], t[1], t[2]};
}

/// The halves of a polygon on both sides of a triangle's plane; one, where it does not run through.
std::vector<Polygon> halvesOf(const Polygon& polygon, const Triangle& by, long double tolerance) {
  const Point normal = (by[1] - by[0]).cross(by[2] - by[0]);
  const long double length = lengthOf(normal);
  if (!(length > 0.0L)) return {polygon};
  std::vector<long double> height;
  for (const Point& p : polygon) height.push_back(normal.dot(p - by[0]) / length);
  const auto [least, most] = std::minmax_element(height.begin(), height.end());
  if (*least > -tolerance || *most < tolerance) return {polygon};
  std::vector<Polygon> halves(2);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (height[i] >= 0.0L) halves[0].push_back(polygon[i]);
    if (height[i] <= 0.0L) halves[1].push_back(polygon[i]);
    if (!(height[i] * height[next] < 0.0L)) continue;
    const long double at = height[i] / (height[i] - height[next]);
    const Point crossing = polygon[i] + (polygon[next] - polygon[i]) * at;
    halves[0].push_back(crossing);
    halves[1].push_back(crossing);
  }
  return halves;
}

class Overlap {
 public:
  Overlap(const WideSurface& a, const WideSurface& b, long double tolerance)
      : a_(a), b_(b), tolerance_(tolerance), part_(a.triangles.size() * b.triangles.size(), -1) {}

  std::vector<int> parts() {
    findMeeting();
    if (meeting_.size() < 2) {
      for (const std::size_t cell : meeting_) part_[cell] = 0;
      return part_;
    }
    cut(false);
    cut(true);
    parent_.resize(pieces_.size() + meeting_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    joinTouching();
    joinAcross();
    for (std::size_t m = 0; m < meeting_.size(); ++m) {
      part_[meeting_[m]] = static_cast<int>(root(pieces_.size() + m));
    }
    return part_;
  }

 private:
  void findMeeting() {
    for (std::size_t i = 0; i < a_.triangles.size(); ++i) {
      for (std::size_t j = 0; j < b_.triangles.size(); ++j) {
        if (areNear(polygonOf(a_.triangles[i]), polygonOf(b_.triangles[j]), tolerance_)) {
          meeting_.push_back(i * b_.triangles.size() + j);
        }
      }
    }
  }

  /// Cuts one body's triangles into pieces and keeps those inside the other body or on its surface.
  void cut(bool is_of_b) {
    const WideSurface& of = is_of_b ? b_ : a_;
    const WideSurface& by = is_of_b ? a_ : b_;
    for (std::size_t t = 0; t < of.triangles.size(); ++t) {
      std::vector<Polygon> polygons{polygonOf(of.triangles[t])};
      for (const Triangle& cutter : by.triangles) {
        std::vector<Polygon> next;
        for (const Polygon& polygon : polygons) {
          if (!Box(polygon).isNear(Box(polygonOf(cutter)), tolerance_) ||
              !areNear(polygon, polygonOf(cutter), tolerance_)) {
            next.push_back(polygon);
            continue;
          }
          for (const Polygon& half : halvesOf(polygon, cutter, tolerance_)) next.push_back(half);
        }
        polygons.swap(next);
      }
      for (const Polygon& polygon : polygons) {
        Point middle{0.0L, 0.0L, 0.0L};
        for (const Point& p : polygon)
          middle = middle + p * (1.0L / static_cast<long double>(polygon.size()));
        const auto is_on = [&](const Triangle& surface) {
          return lengthOf(closestOnTriangle(middle, surface) - middle) <= 2.0L * tolerance_;
        };
        if (holds(by, middle) || std::any_of(by.triangles.begin(), by.triangles.end(), is_on)) {
          pieces_.push_back({polygon, Box(polygon), t, is_of_b});
        }
      }
    }
  }

  void joinTouching() {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (root(i) == root(j) || !pieces_[i].box.isNear(pieces_[j].box, tolerance_)) continue;
        if (areNear(pieces_[i].corners, pieces_[j].corners, tolerance_)) unite(i, j);
      }
    }
    const std::size_t count_b = b_.triangles.size();
    for (std::size_t m = 0; m < meeting_.size(); ++m) {
      const std::size_t of_a = meeting_[m] / count_b;
      const std::size_t of_b = meeting_[m] % count_b;
      for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (pieces_[i].triangle != (pieces_[i].is_of_b ? of_b : of_a)) continue;
        const Triangle& other = pieces_[i].is_of_b ? a_.triangles[of_a] : b_.triangles[of_b];
        if (areNear(pieces_[i].corners, polygonOf(other), tolerance_)) unite(i, pieces_.size() + m);
      }
    }
  }

  /// Joins what bounds one part of the overlap from within and from around.
  void joinAcross() {
    std::vector<std::size_t> rays(parent_.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (rays[root(i)]++ >= kRaysOfPart) continue;
      castRay(i, {0.3141L, 0.8517L, -0.4189L});
      castRay(i, {-0.7321L, 0.2113L, 0.6477L});
    }
  }

  void castRay(std::size_t piece, const Point& along) {
    struct Hit {
      long double at;
      std::size_t triangle;
      bool is_of_b;
    };
    const Polygon& corners = pieces_[piece].corners;
    Point from = corners[0] * 0.41L + corners[1] * 0.27L + corners[2] * 0.32L;
    std::vector<Hit> hits;
    for (const bool is_of_b : {false, true}) {
      const std::vector<Triangle>& triangles = is_of_b ? b_.triangles : a_.triangles;
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& face = triangles[t];
        const Point normal = (face[1] - face[0]).cross(face[2] - face[0]);
        const long double rise = normal.dot(along);
        if (rise == 0.0L) continue;
        const long double at = normal.dot(face[0] - from) / rise;
        if (at > 0.0L && exactlyInside(from + along * at, face, normal)) hits.push_back({at, t, is_of_b});
      }
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& l, const Hit& r) { return l.at < r.at; });
    std::size_t before = piece;
    long double reached = 0.0L;
    for (const Hit& hit : hits) {
      const std::size_t here = pieceAt(from + along * hit.at, hit.triangle, hit.is_of_b);
      const Point middle = from + along * (0.5L * (reached + hit.at));
      const bool is_known = before != pieces_.size() && here != pieces_.size();
      if (is_known && hit.at - reached > 8.0L * tolerance_ && root(before) != root(here) &&
          holds(a_, middle) && holds(b_, middle)) {
        unite(before, here);
      }
      before = here;
      reached = hit.at;
    }
  }

  std::size_t pieceAt(const Point& point, std::size_t triangle, bool is_of_b) const {
    const auto found = std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
      return piece.triangle == triangle && piece.is_of_b == is_of_b &&
             areNear({point, point, point}, piece.corners, 2.0L * tolerance_);
    });
    return static_cast<std::size_t>(found - pieces_.begin());
  }

  /// Whether the closed shells wind around a point: solid angles (van Oosterom and Strackee 1983).
  static bool holds(const WideSurface& surface, const Point& point) {
    long double sum = 0.0L;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (!surface.is_closed[t]) continue;
      const Point a = surface.triangles[t][0] - point;
      const Point b = surface.triangles[t][1] - point;
      const Point c = surface.triangles[t][2] - point;
      const long double la = lengthOf(a);
      const long double lb = lengthOf(b);
      const long double lc = lengthOf(c);
      sum +=
          2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum > 2.0L * std::acos(-1.0L);
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t l, std::size_t r) { parent_[root(l)] = root(r); }

  const WideSurface& a_;
  const WideSurface& b_;
  long double tolerance_;
  std::vector<int> part_;
  std::vector<std::size_t> meeting_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<int> overlapPartsOfPairs(const WideSurface& a, const WideSurface& b, long double tolerance) {
  return Overlap(a, b, tolerance).parts();
}

}  // namespace concave_distance::test
