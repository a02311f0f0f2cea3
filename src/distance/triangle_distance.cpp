#include "concave_distance/distance/triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle_crossing.h"

// Method: the pair of closest points lies on an edge of each triangle, or on a vertex of one and the face of
// the other, or the triangles cross. Each of the nine edge pairs and six vertex-face pairs gives a pair of
// points that do lie on the triangles, so the least of them is never too small by more than rounding; it is
// not too large because each kernel below is stable on its own (the reasons stand beside the formulas). An
// edge pair whose direction separates the triangles ends the search at once (Larsen et al. 1999, PQP).
//
// In the comments eps is the machine epsilon, w a vector from one triangle to the other, and "wrong by"
// leaves out small factors; the constants of the header are tested as they are stated
// (test/distance/triangle_distance_accuracy_test.cpp).

namespace concave_distance {
namespace {

using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double clampToUnit(double x) {
  return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x);
}

double inverseOrZero(double x) {
  return x > 0.0 ? 1.0 / x : 0.0;
}

Feature vertexFeature(std::size_t corner) {
  return static_cast<Feature>(corner);
}
Feature edgeFeature(std::size_t edge) {
  return static_cast<Feature>(3 + edge);
}

std::size_t nextCorner(std::size_t k) {
  return k == 2 ? 0 : k + 1;
}
std::size_t previousCorner(std::size_t k) {
  return k == 0 ? 2 : k - 1;
}

/// A triangle with what every kernel needs of it.
struct Prepared {
  explicit Prepared(const TrianglePoints& points)
      : corners(points),
        edges{points[1] - points[0], points[2] - points[1], points[0] - points[2]},
        squared_lengths{edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm()},
        inverse_squared_lengths{inverseOrZero(squared_lengths[0]), inverseOrZero(squared_lengths[1]),
                                inverseOrZero(squared_lengths[2])} {}

  double size() const { return squared_lengths[0] + squared_lengths[1] + squared_lengths[2]; }

  const TrianglePoints& corners;
  std::array<Vector3d, 3> edges;  ///< from corner k to corner (k + 1) % 3
  std::array<double, 3> squared_lengths;
  std::array<double, 3> inverse_squared_lengths;  ///< 0 for an edge without length
};

/// The triangle's inside as seen from any point: coordinates along the longest edge (0 to 1) and along the
/// height on it (0 at the edge, 1 at the opposite corner). For a needle or cap whose height is phi times its
/// length the height's direction is wrong by eps / phi. It is only used on what the longest edge leaves of a
/// point, at most phi times the length plus the gap, so that the foot is wrong by eps times the length plus
/// eps / phi times the gap; the latter turns the gap and, the edges being nearer than phi, lengthens it by no
/// more than eps times the length.
class FaceFrame {
 public:
  explicit FaceFrame(const Prepared& t) {
    base_ = t.squared_lengths[0] >= t.squared_lengths[1] ? 0 : 1;
    if (t.squared_lengths[2] > t.squared_lengths[base_]) base_ = 2;
    corner_ = t.corners[base_];
    edge_ = t.edges[base_];
    inverse_ee_ = t.inverse_squared_lengths[base_];
    side_ = -t.edges[previousCorner(base_)];
    side_along_ = side_.dot(edge_) * inverse_ee_;
    height_ = side_ - side_along_ * edge_;
    inverse_hh_ = inverseOrZero(height_.squaredNorm());
  }

  bool flat() const { return inverse_hh_ == 0.0; }

  /// Whether `point` projects inside, and where; the foot lies on the triangle whatever the rounding.
  bool isOver(const Vector3d& point, Vector3d& foot) const {
    const Vector3d w = point - corner_;
    const double along = w.dot(edge_) * inverse_ee_;
    if (!(along > 0.0 && along < 1.0)) return false;
    const double up = (w - along * edge_).dot(height_) * inverse_hh_;
    const double weight_next = along - up * side_along_;
    if (!(up > 0.0 && weight_next > 0.0 && weight_next + up < 1.0)) return false;
    foot = corner_ + (weight_next * edge_ + up * side_);
    return true;
  }

 private:
  std::size_t base_ = 0;  ///< the longest edge
  Vector3d corner_;       ///< where it starts
  Vector3d edge_;
  Vector3d side_;            ///< from there to the opposite corner
  Vector3d height_;          ///< the part of it across the edge
  double side_along_ = 0.0;  ///< where the height stands on the edge
  double inverse_ee_ = 0.0;
  double inverse_hh_ = 0.0;  ///< 0 for a triangle without area
};

/// The closest pair found so far: points on edges by their parameters, or as they are.
struct Best {
  double squared_distance = std::numeric_limits<double>::infinity();
  Vector3d between = Vector3d::Zero();  ///< from a's witness to b's
  std::size_t edge_a = 0;
  std::size_t edge_b = 0;
  double along_a = 0.0;
  double along_b = 0.0;
};

/// Closest points of edge i of a and edge j of b. With w from a's corner to b's, |w + t v - s u| is least.
/// The crossing's parameter comes from cross products, s = ((w x v) . n) / n . n with n = u x v, and not from
/// u.u v.v - (u.v)^2: for edges at an angle phi the former is wrong by eps / phi, which moves the point by
/// eps across the other edge, the latter by eps / phi^2. Parallel edges may start anywhere: the clamping
/// below then finds a common stretch.
void considerEdges(const Prepared& a, std::size_t i, const Prepared& b, std::size_t j, const Vector3d& w,
                   Best& candidate) {
  const Vector3d& u = a.edges[i];
  const Vector3d& v = b.edges[j];
  const Vector3d n = u.cross(v);
  const double nn = n.squaredNorm();
  double s = nn > 0.0 ? clampToUnit(w.cross(v).dot(n) / nn) : 0.0;
  double t = v.dot(s * u - w) * b.inverse_squared_lengths[j];
  if (!(t > 0.0 && t < 1.0)) {
    t = clampToUnit(t);
    s = clampToUnit(u.dot(w + t * v) * a.inverse_squared_lengths[i]);
  }
  candidate.between = w + t * v - s * u;
  candidate.squared_distance = candidate.between.squaredNorm();
  candidate.edge_a = i;
  candidate.edge_b = j;
  candidate.along_a = s;
  candidate.along_b = t;
}

/// Whether the planes through the candidate's points across its direction d part the triangles: then nothing
/// is closer than the candidate less what corners stick out beyond them. That is held to a rounding of the
/// triangles' size and not of the gap, which a gap much smaller than the triangles cannot show (d is itself
/// rounded); such pairs go through all candidates.
bool separates(const Prepared& a, const Prepared& b, const Best& c, double squared_size) {
  const Vector3d& d = c.between;
  const double along_a = d.dot(a.edges[c.edge_a]);
  const double along_b = d.dot(b.edges[c.edge_b]);
  const double own_a = std::max(-c.along_a * along_a, (1.0 - c.along_a) * along_a);
  const double own_b = std::max(c.along_b * along_b, (c.along_b - 1.0) * along_b);
  const double opposite_a = -d.dot(a.edges[previousCorner(c.edge_a)]) - c.along_a * along_a;
  const double opposite_b = d.dot(b.edges[previousCorner(c.edge_b)]) + c.along_b * along_b;
  const double beyond = std::max(std::max(own_a, opposite_a), std::max(own_b, opposite_b));
  constexpr double kSquaredTolerance = kEpsilon * kEpsilon;
  return beyond <= 0.0 || beyond * beyond <= kSquaredTolerance * squared_size * c.squared_distance;
}

Vector3d pointOnEdge(const Prepared& t, std::size_t edge, double along, Feature& feature) {
  if (along <= 0.0) {
    feature = vertexFeature(edge);
    return t.corners[edge];
  }
  if (along >= 1.0) {
    feature = vertexFeature(nextCorner(edge));
    return t.corners[nextCorner(edge)];
  }
  feature = edgeFeature(edge);
  return t.corners[edge] + along * t.edges[edge];
}

TrianglePairDistance fromPoints(const Vector3d& point_a, const Vector3d& point_b, Feature feature_a,
                                Feature feature_b) {
  return {(point_b - point_a).squaredNorm(), point_a, point_b, feature_a, feature_b};
}

TrianglePairDistance fromEdges(const Prepared& a, const Prepared& b, const Best& best) {
  Feature feature_a{};
  Feature feature_b{};
  const Vector3d point_a = pointOnEdge(a, best.edge_a, best.along_a, feature_a);
  const Vector3d point_b = pointOnEdge(b, best.edge_b, best.along_b, feature_b);
  return fromPoints(point_a, point_b, feature_a, feature_b);
}

/// True when the direction between the witnesses parts the triangles by more than rounding could feign.
bool certainlyApart(const Prepared& a, const Prepared& b, const TrianglePairDistance& result) {
  const Vector3d d = result.point_b - result.point_a;
  double beyond_a = 0.0;
  double before_b = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    beyond_a = std::max(beyond_a, d.dot(a.corners[k] - result.point_a));
    before_b = std::min(before_b, d.dot(b.corners[k] - result.point_b));
  }
  return beyond_a - before_b < 0.5 * result.squared_distance;
}

/// Within these no product of coordinates over- or underflows harmfully.
constexpr double kLeastSquare = 1e-100;
constexpr double kLargestSquare = 1e60;

TrianglePairDistance distanceInRange(const Prepared& a, const Prepared& b) {
  const double squared_size = a.size() + b.size();
  Best best;
  Best candidate;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      considerEdges(a, i, b, j, b.corners[j] - a.corners[i], candidate);
      if (candidate.squared_distance < best.squared_distance) {
        best = candidate;
        if (separates(a, b, best, squared_size)) return fromEdges(a, b, best);
      }
    }
  }
  TrianglePairDistance result = fromEdges(a, b, best);
  Vector3d foot;
  if (const FaceFrame face(a); !face.flat()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face.isOver(b.corners[k], foot)) continue;
      if ((b.corners[k] - foot).squaredNorm() < result.squared_distance) {
        result = fromPoints(foot, b.corners[k], Feature::Face, vertexFeature(k));
      }
    }
  }
  if (const FaceFrame face(b); !face.flat()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face.isOver(a.corners[k], foot)) continue;
      if ((a.corners[k] - foot).squaredNorm() < result.squared_distance) {
        result = fromPoints(a.corners[k], foot, vertexFeature(k), Feature::Face);
      }
    }
  }
  if (certainlyApart(a, b, result)) return result;
  if (const detail::TriangleCrossing crossing = detail::findCrossing(a.corners, b.corners); crossing.found) {
    return fromPoints(crossing.point, crossing.point, crossing.feature_a, crossing.feature_b);
  }
  return result;
}

/// By a power of two, so that nothing is rounded; what then still underflows is far below the error bound.
TrianglePairDistance scaledDistance(const TrianglePoints& a, const TrianglePoints& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max({largest, a[k].cwiseAbs().maxCoeff(), b[k].cwiseAbs().maxCoeff()});
  }
  if (!(largest > 0.0)) return fromPoints(a[0], b[0], Feature::Vertex0, Feature::Vertex0);
  const int exponent = -std::ilogb(largest);
  const auto scaled = [exponent](const Vector3d& v) {
    return Vector3d(std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent));
  };
  const TrianglePoints scaled_a = {scaled(a[0]), scaled(a[1]), scaled(a[2])};
  const TrianglePoints scaled_b = {scaled(b[0]), scaled(b[1]), scaled(b[2])};
  const TrianglePairDistance result = distanceInRange(Prepared(scaled_a), Prepared(scaled_b));
  const auto back = [exponent](const Vector3d& v) {
    return Vector3d(std::ldexp(v.x(), -exponent), std::ldexp(v.y(), -exponent), std::ldexp(v.z(), -exponent));
  };
  return fromPoints(back(result.point_a), back(result.point_b), result.feature_a, result.feature_b);
}

}  // namespace

PointTriangleDistance pointTriangleDistance(const Vector3d& point, const TrianglePoints& triangle) {
  const Prepared t(triangle);
  PointTriangleDistance best{std::numeric_limits<double>::infinity(), triangle[0], Feature::Vertex0};
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = clampToUnit(t.edges[k].dot(point - t.corners[k]) * t.inverse_squared_lengths[k]);
    Feature feature{};
    const Vector3d candidate = pointOnEdge(t, k, along, feature);
    const double squared_distance = (candidate - point).squaredNorm();
    if (squared_distance < best.squared_distance) best = {squared_distance, candidate, feature};
  }
  Vector3d foot;
  if (const FaceFrame face(t); !face.flat() && face.isOver(point, foot)) {
    const double squared_distance = (foot - point).squaredNorm();
    if (squared_distance < best.squared_distance) best = {squared_distance, foot, Feature::Face};
  }
  return best;
}

TrianglePairDistance triangleDistance(const TrianglePoints& a, const TrianglePoints& b) {
  const Prepared prepared_a(a);
  const Prepared prepared_b(b);
  const double size = prepared_a.size() + prepared_b.size() + (b[0] - a[0]).squaredNorm();
  if (!(size > kLeastSquare && size < kLargestSquare)) return scaledDistance(a, b);
  return distanceInRange(prepared_a, prepared_b);
}

}  // namespace concave_distance
