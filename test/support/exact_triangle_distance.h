#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include "distance/kernels/triangle_distance.h"

/// The distance of two triangles from its definition, in a number type wide enough that rounding does not
/// matter: the least over every pair of features whose affine hulls have their closest points inside both
/// features. Shares nothing with the kernel it judges.
namespace concave_distance::test {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                           boost::multiprecision::et_off>;  ///< 100 decimal digits
using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                               boost::multiprecision::et_off>;  ///< exact

template <typename Real>
struct ExactVector {
  Real x, y, z;
  explicit ExactVector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}
  ExactVector(Real x_in, Real y_in, Real z_in) : x(x_in), y(y_in), z(z_in) {}
  ExactVector operator-(const ExactVector& o) const { return {x - o.x, y - o.y, z - o.z}; }
  ExactVector operator+(const ExactVector& o) const { return {x + o.x, y + o.y, z + o.z}; }
  ExactVector operator*(const Real& f) const { return {x * f, y * f, z * f}; }
  Real dot(const ExactVector& o) const { return x * o.x + y * o.y + z * o.z; }
  Real squaredNorm() const { return dot(*this); }
  ExactVector cross(const ExactVector& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
};

template <typename Real>
using ExactTriangle = std::array<ExactVector<Real>, 3>;

template <typename Real>
ExactTriangle<Real> exactTriangle(const TrianglePoints& t) {
  return {ExactVector<Real>(t[0]), ExactVector<Real>(t[1]), ExactVector<Real>(t[2])};
}

/// Whether a point of the triangle's plane lies in the closed triangle; `normal` is not zero.
template <typename Real>
bool exactlyInside(const ExactVector<Real>& p, const ExactTriangle<Real>& t,
                   const ExactVector<Real>& normal) {
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactVector<Real> edge = t[(k + 1) % 3] - t[k];
    if (edge.cross(p - t[k]).dot(normal) < 0) return false;
  }
  return true;
}

/// The point of a triangle, a segment or a point (repeated corners) that is nearest to p.
template <typename Real>
ExactVector<Real> closestOnTriangle(const ExactVector<Real>& p, const ExactTriangle<Real>& t) {
  const ExactVector<Real> normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const Real squared_area = normal.squaredNorm();
  if (squared_area > 0) {
    const ExactVector<Real> foot = p - normal * Real(normal.dot(p - t[0]) / squared_area);
    if (exactlyInside(foot, t, normal)) return foot;
  }
  ExactVector<Real> best = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactVector<Real> edge = t[(k + 1) % 3] - t[k];
    const Real squared = edge.squaredNorm();
    const Real along =
        squared > 0 ? std::clamp(Real(edge.dot(p - t[k]) / squared), Real(0), Real(1)) : Real(0);
    const ExactVector<Real> on = t[k] + edge * along;
    if ((on - p).squaredNorm() < (best - p).squaredNorm()) best = on;
  }
  return best;
}

/// Vertices of a against everything of b, and edges of a through the face of b.
template <typename Real>
void considerOneSide(const ExactTriangle<Real>& a, const ExactTriangle<Real>& b, Real& least) {
  const ExactVector<Real> normal = (b[1] - b[0]).cross(b[2] - b[0]);
  const Real squared_area = normal.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      least = std::min(least, Real((a[i] - b[k]).squaredNorm()));
      const ExactVector<Real> edge = b[(k + 1) % 3] - b[k];
      const Real squared_length = edge.squaredNorm();
      const Real along = edge.dot(a[i] - b[k]);
      if (along > 0 && along < squared_length) {
        least = std::min(least, Real((a[i] - (b[k] + edge * Real(along / squared_length))).squaredNorm()));
      }
    }
    if (!(squared_area > 0)) continue;
    const Real height = normal.dot(a[i] - b[0]);
    if (exactlyInside(a[i] - normal * Real(height / squared_area), b, normal)) {
      least = std::min(least, Real(height * height / squared_area));
    }
    const std::size_t next = (i + 1) % 3;
    const Real next_height = normal.dot(a[next] - b[0]);
    if ((height < 0 && next_height > 0) || (height > 0 && next_height < 0)) {
      const ExactVector<Real> at = a[i] + (a[next] - a[i]) * Real(height / (height - next_height));
      if (exactlyInside(at, b, normal)) least = 0;
    }
  }
}

template <typename Real>
Real exactSquaredDistance(const ExactTriangle<Real>& a, const ExactTriangle<Real>& b) {
  Real least = (a[0] - b[0]).squaredNorm();
  considerOneSide(a, b, least);
  considerOneSide(b, a, least);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const ExactVector<Real> u = a[(i + 1) % 3] - a[i];
      const ExactVector<Real> v = b[(j + 1) % 3] - b[j];
      const ExactVector<Real> w = b[j] - a[i];
      const Real uu = u.squaredNorm();
      const Real vv = v.squaredNorm();
      const Real uv = u.dot(v);
      const Real determinant = uu * vv - uv * uv;
      if (!(determinant > 0)) continue;  // parallel: an end of one is as close
      const Real s = (w.dot(u) * vv - w.dot(v) * uv) / determinant;
      const Real t = (w.dot(u) * uv - w.dot(v) * uu) / determinant;
      if (s < 0 || s > 1 || t < 0 || t > 1) continue;
      least = std::min(least, Real((w + v * t - u * s).squaredNorm()));
    }
  }
  return least;
}

template <typename Real>
Real exactSquaredDistance(const TrianglePoints& a, const TrianglePoints& b) {
  return exactSquaredDistance(exactTriangle<Real>(a), exactTriangle<Real>(b));
}

/// Rounded to nearest.
double exactDistance(const TrianglePoints& a, const TrianglePoints& b);

/// Distance of a point from a triangle; segments and points are triangles whose corners repeat.
double exactDistance(const Eigen::Vector3d& point, const TrianglePoints& t);

/// |computed - exact| with the subtraction done in the wide type.
double exactDistanceError(double computed, const TrianglePoints& a, const TrianglePoints& b);

extern template Wide exactSquaredDistance(const ExactTriangle<Wide>& a, const ExactTriangle<Wide>& b);

inline double largestCoordinate(const TrianglePoints& a, const TrianglePoints& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max({largest, a[k].cwiseAbs().maxCoeff(), b[k].cwiseAbs().maxCoeff()});
  }
  return largest;
}

/// The part of a triangle that a feature names, as a triangle with repeated corners.
inline TrianglePoints featureOf(const TrianglePoints& t, Feature feature) {
  const auto code = static_cast<std::size_t>(feature);
  if (code < 3) return {t[code], t[code], t[code]};
  if (code < 6) return {t[code - 3], t[(code - 2) % 3], t[(code - 2) % 3]};
  return t;
}

}  // namespace concave_distance::test
