#include "triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "prepared_triangle.h"
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

using detail::FaceFrame;
using detail::nextCorner;
using detail::PreparedTriangle;
using detail::previousCorner;
using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double clampToUnit(double x) {
  return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x);
}

Feature vertexFeature(std::size_t corner) {
  return static_cast<Feature>(corner);
}
Feature edgeFeature(std::size_t edge) {
  return static_cast<Feature>(3 + edge);
}

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
void considerEdges(const PreparedTriangle& a, std::size_t i, const PreparedTriangle& b, std::size_t j,
                   const Vector3d& w, Best& candidate) {
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
bool separates(const PreparedTriangle& a, const PreparedTriangle& b, const Best& c, double squared_size) {
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

Vector3d pointOnEdge(const PreparedTriangle& t, std::size_t edge, double along, Feature& feature) {
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

TrianglePairDistance fromEdges(const PreparedTriangle& a, const PreparedTriangle& b, const Best& best) {
  Feature feature_a{};
  Feature feature_b{};
  const Vector3d point_a = pointOnEdge(a, best.edge_a, best.along_a, feature_a);
  const Vector3d point_b = pointOnEdge(b, best.edge_b, best.along_b, feature_b);
  return fromPoints(point_a, point_b, feature_a, feature_b);
}

/// True when the direction between the witnesses parts the triangles by more than rounding could feign.
bool certainlyApart(const PreparedTriangle& a, const PreparedTriangle& b,
                    const TrianglePairDistance& result) {
  const Vector3d d = result.point_b - result.point_a;
  double beyond_a = 0.0;
  double before_b = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    beyond_a = std::max(beyond_a, d.dot(a.corners[k] - result.point_a));
    before_b = std::min(before_b, d.dot(b.corners[k] - result.point_b));
  }
  return beyond_a - before_b < 0.5 * result.squared_distance;
}

TrianglePairDistance distanceInRange(const PreparedTriangle& a, const PreparedTriangle& b) {
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
  const TrianglePairDistance result = distanceInRange(PreparedTriangle(scaled_a), PreparedTriangle(scaled_b));
  const auto back = [exponent](const Vector3d& v) {
    return Vector3d(std::ldexp(v.x(), -exponent), std::ldexp(v.y(), -exponent), std::ldexp(v.z(), -exponent));
  };
  return fromPoints(back(result.point_a), back(result.point_b), result.feature_a, result.feature_b);
}

}  // namespace

PointTriangleDistance pointTriangleDistance(const Vector3d& point, const TrianglePoints& triangle) {
  const PreparedTriangle t(triangle);
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
  const PreparedTriangle prepared_a(a);
  const PreparedTriangle prepared_b(b);
  const double size = prepared_a.size() + prepared_b.size() + (b[0] - a[0]).squaredNorm();
  if (!(size > detail::kLeastSquare && size < detail::kLargestSquare)) return scaledDistance(a, b);
  return distanceInRange(prepared_a, prepared_b);
}

}  // namespace concave_distance
