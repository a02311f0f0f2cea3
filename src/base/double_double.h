#pragma once

#include <Eigen/Geometry>
#include <array>

namespace concave_distance::detail {

/// An unevaluated sum of two doubles, about 106 bits (Dekker 1971). Right as long as nothing over- or
/// underflows, and as long as the compiler fuses no product into a sum: what includes this is compiled with
/// -ffp-contract=off (see src/distance/CMakeLists.txt).
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  double value() const { return high + low; }
  int sign() const {
    if (high != 0.0) return high > 0.0 ? 1 : -1;
    return (low > 0.0) - (low < 0.0);
  }
};

/// Exact.
inline DoubleDouble twoSum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// Exact for |a| >= |b|.
inline DoubleDouble quickTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Exact; splits both factors into halves (Veltkamp).
inline DoubleDouble twoProduct(double a, double b) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double a_big = kSplitter * a;
  const double a_high = a_big - (a_big - a);
  const double a_low = a - a_high;
  const double b_big = kSplitter * b;
  const double b_high = b_big - (b_big - b);
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  DoubleDouble high = twoSum(a.high, b.high);
  const DoubleDouble low = twoSum(a.low, b.low);
  high = quickTwoSum(high.high, high.low + low.high);
  return quickTwoSum(high.high, high.low + low.low);
}

inline DoubleDouble operator-(DoubleDouble a) {
  return {-a.high, -a.low};
}
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
  return a + (-b);
}

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  DoubleDouble product = twoProduct(a.high, b.high);
  product.low += a.high * b.low + a.low * b.high;
  return quickTwoSum(product.high, product.low);
}

/// Two steps of long division; relative error about 2^-100.
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.high / b.high;
  DoubleDouble rest = a - b * DoubleDouble{first, 0.0};
  const double second = rest.high / b.high;
  rest = rest - b * DoubleDouble{second, 0.0};
  const double third = rest.high / b.high;
  return quickTwoSum(first, second) + DoubleDouble{third, 0.0};
}

using WideVector = std::array<DoubleDouble, 3>;

/// Exact.
inline WideVector wideDifference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {twoSum(a.x(), -b.x()), twoSum(a.y(), -b.y()), twoSum(a.z(), -b.z())};
}

inline WideVector operator-(const WideVector& a, const WideVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// a + factor * b
inline WideVector advance(const WideVector& a, DoubleDouble factor, const WideVector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

inline DoubleDouble dot(const WideVector& a, const WideVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline WideVector cross(const WideVector& a, const WideVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace concave_distance::detail
