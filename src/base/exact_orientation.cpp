#include "exact_orientation.h"

#include "expansion.h"

namespace concave_distance::detail {
namespace {

constexpr double kHalfUlp = 0x1.0p-53;
constexpr double kFilter = (7.0 + 56.0 * kHalfUlp) * kHalfUlp;  ///< Shewchuk's o3derrboundA
constexpr double kCrossFilter = (3.0 + 16.0 * kHalfUlp) * kHalfUlp;
constexpr double kWideFilter = 0x1.0p-96;  ///< generous: some twenty operations of error 2^-104
/// Above this share of the permanent a sum of two doubles has all 53 bits of the determinant.
constexpr double kWideAccurate = 0x1.0p-40;

struct Determinant {
  double value;
  double permanent;  ///< the same sum of magnitudes
};

Determinant plainDeterminant(const Eigen::Vector3d& u, const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  const double yz = u[1] * v[2];
  const double zy = u[2] * v[1];
  const double zx = u[2] * v[0];
  const double xz = u[0] * v[2];
  const double xy = u[0] * v[1];
  const double yx = u[1] * v[0];
  return {w[0] * (yz - zy) + w[1] * (zx - xz) + w[2] * (xy - yx),
          std::abs(w[0]) * (std::abs(yz) + std::abs(zy)) + std::abs(w[1]) * (std::abs(zx) + std::abs(xz)) +
              std::abs(w[2]) * (std::abs(xy) + std::abs(yx))};
}

DoubleDouble wideDeterminant(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                             const Eigen::Vector3d& s) {
  return dot(cross(wideDifference(q, p), wideDifference(r, p)), wideDifference(s, p));
}

using ExactVector = std::array<Expansion, 3>;

ExactVector exactDifference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {Expansion::difference(a[0], b[0]), Expansion::difference(a[1], b[1]),
          Expansion::difference(a[2], b[2])};
}

ExactVector exactCross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Expansion exactDot(const ExactVector& a, const ExactVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Expansion exactDeterminant(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                           const Eigen::Vector3d& s) {
  return exactDot(exactCross(exactDifference(q, p), exactDifference(r, p)), exactDifference(s, p));
}

int signOf(double value) {
  return (value > 0.0) - (value < 0.0);
}

int crossSign(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
              const Eigen::Vector3d& s, int axis) {
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  const double left = (q[i] - p[i]) * (s[j] - r[j]);
  const double right = (q[j] - p[j]) * (s[i] - r[i]);
  const double value = left - right;
  if (std::abs(value) > kCrossFilter * (std::abs(left) + std::abs(right))) return signOf(value);
  return (Expansion::difference(q[i], p[i]) * Expansion::difference(s[j], r[j]) -
          Expansion::difference(q[j], p[j]) * Expansion::difference(s[i], r[i]))
      .sign();
}

}  // namespace

int orientationSign(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                    const Eigen::Vector3d& s) {
  const Determinant plain = plainDeterminant(q - p, r - p, s - p);
  if (std::abs(plain.value) > kFilter * plain.permanent) return signOf(plain.value);
  const DoubleDouble wide = wideDeterminant(p, q, r, s);
  if (std::abs(wide.high) > kWideFilter * plain.permanent) return signOf(wide.high);
  return exactDeterminant(p, q, r, s).sign();
}

double orientationValue(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                        const Eigen::Vector3d& s) {
  const Determinant plain = plainDeterminant(q - p, r - p, s - p);
  const DoubleDouble wide = wideDeterminant(p, q, r, s);
  if (std::abs(wide.high) > kWideAccurate * plain.permanent) return wide.value();
  return exactDeterminant(p, q, r, s).value();
}

int signAlong(const Motion& motion, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
              const Eigen::Vector3d& r, const Eigen::Vector3d& s) {
  for (int axis = 0; axis < 3; ++axis) {
    const int sign = crossSign(p, q, r, s, axis);
    if (sign != 0) return motion[static_cast<std::size_t>(axis)] * sign;
  }
  return 0;
}

int planeOrder(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const PlaneOnSegment& first,
               const PlaneOnSegment& second, const Motion& motion) {
  // The segment meets plane i at p_i / (p_i - q_i), p_i and q_i the heights of its ends over it.
  std::array<Expansion, 2> height_p;
  std::array<Expansion, 2> height_q;
  const PlaneOnSegment* planes[2] = {&first, &second};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& corner = planes[i]->corner;
    height_p[i] = exactDeterminant(*corner[0], *corner[1], *corner[2], p);
    height_q[i] = exactDeterminant(*corner[0], *corner[1], *corner[2], q);
  }
  const int sides = first.side_of_p * second.side_of_p;
  const int order = (height_p[1] * height_q[0] - height_p[0] * height_q[1]).sign();
  if (order != 0) return sides * order;
  // A motion e changes both heights over plane i by n_i . e, and what was compared, p_2 q_1 - p_1 q_2, by
  // ((p - q) x (n_1 x n_2)) . e; the squares cancel.
  std::array<ExactVector, 2> normal;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& corner = planes[i]->corner;
    normal[i] = exactCross(exactDifference(*corner[1], *corner[0]), exactDifference(*corner[2], *corner[0]));
  }
  const ExactVector change = exactCross(exactDifference(p, q), exactCross(normal[0], normal[1]));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (change[axis].sign() != 0) return sides * motion[axis] * change[axis].sign();
  }
  return 0;
}

}  // namespace concave_distance::detail
