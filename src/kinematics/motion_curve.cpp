#include "motion_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace concave_distance::detail {
namespace {

using Coefficients = MotionCurve::Coefficients;

/// Returns the Bernstein coefficients of a polynomial on a part of [0, 1]: its values there lie between the
/// least and the largest of them, and its integral is their mean times the length.
Coefficients bernstein(Coefficients polynomial, std::size_t degree, double from, double to) {
  // Taylor shift to `from`, then the powers are scaled to the part's length.
  for (std::size_t i = 0; i < degree; ++i) {
    for (std::size_t k = degree; k-- > i;) polynomial[k] += from * polynomial[k + 1];
  }
  double power = 1.0;
  for (std::size_t k = 1; k <= degree; ++k) polynomial[k] *= power *= to - from;
  // b_i = sum of binomial(i, k) / binomial(degree, k) c_k, by differences.
  double binomial = 1.0;
  for (std::size_t k = 1; k <= degree; ++k) {
    binomial *= static_cast<double>(degree - k + 1) / static_cast<double>(k);
    polynomial[k] /= binomial;
  }
  for (std::size_t i = 1; i <= degree; ++i) {
    for (std::size_t k = degree; k >= i; --k) polynomial[k] += polynomial[k - 1];
  }
  return polynomial;
}

double largest(const Coefficients& numbers, std::size_t degree) {
  double most = 0.0;
  for (std::size_t i = 0; i <= degree; ++i) most = std::max(most, std::abs(numbers[i]));
  return most;
}

double evaluated(const Coefficients& polynomial, std::size_t degree, double at) {
  double value = polynomial[degree];
  for (std::size_t k = degree; k-- > 0;) value = value * at + polynomial[k];
  return value;
}

Coefficients derivative(const Coefficients& polynomial, std::size_t degree) {
  Coefficients rates{};
  for (std::size_t k = 1; k <= degree; ++k) rates[k - 1] = static_cast<double>(k) * polynomial[k];
  return rates;
}

}  // namespace

MotionMoment momentAt(double moment, std::size_t segments) {
  const auto segment = std::min(static_cast<std::size_t>(moment), segments - 1);
  return {segment, moment - static_cast<double>(segment)};
}

MotionCurve MotionCurve::straight(const std::vector<double>& values) {
  std::vector<Coefficients> segments;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    segments.push_back({values[i], values[i + 1] - values[i]});
  }
  if (segments.empty()) segments.push_back({values.front()});
  return {std::move(segments), 1};
}

MotionCurve::MotionCurve(std::vector<Coefficients> segments, std::size_t degree)
    : segments_(std::move(segments)), degree_(degree) {
  variation_before_.push_back(0.0);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    double sum = 0.0;
    for (const double coefficient : segments_[i]) sum += std::abs(coefficient);
    magnitude_ = std::max(magnitude_, sum);
    variation_before_.push_back(variation_before_.back() + bounds(i, 0.0, 1.0).variation);
  }
}

MotionCurve MotionCurve::scaled(double factor, double offset) const {
  std::vector<Coefficients> segments = segments_;
  for (Coefficients& segment : segments) {
    for (double& coefficient : segment) coefficient *= factor;
    segment[0] += offset;
  }
  return {std::move(segments), degree_};
}

double MotionCurve::value(MotionMoment at) const {
  return evaluated(segments_[at.segment], degree_, at.share);
}

double MotionCurve::rate(MotionMoment at) const {
  if (degree_ == 1) return segments_[at.segment][1];
  return evaluated(derivative(segments_[at.segment], degree_), degree_ - 1, at.share);
}

MotionCurve::Bounds MotionCurve::bounds(std::size_t segment, double from, double to) const {
  if (degree_ == 1) {
    const double rate = std::abs(segments_[segment][1]);
    return {rate, 0.0, rate * (to - from)};
  }
  const Coefficients rates = derivative(segments_[segment], degree_);
  const Coefficients accelerations = derivative(rates, degree_ - 1);
  const Coefficients rate_bounds = bernstein(rates, degree_ - 1, from, to);
  double sum = 0.0;
  for (std::size_t i = 0; i < degree_; ++i) sum += std::abs(rate_bounds[i]);
  // Coefficients lose some units of rounding of the largest terms to cancellation.
  const double rounding = 0x1.0p-46 * largest(rates, degree_ - 1);
  const double acceleration_rounding = 0x1.0p-46 * largest(accelerations, degree_ - 2);
  return {largest(rate_bounds, degree_ - 1) + rounding,
          largest(bernstein(accelerations, degree_ - 2, from, to), degree_ - 2) + acceleration_rounding,
          (sum / static_cast<double>(degree_) + rounding) * (to - from)};
}

double MotionCurve::variation(double from, double to) const {
  const MotionMoment first = momentAt(from, segments_.size());
  const MotionMoment last = momentAt(to, segments_.size());
  if (first.segment == last.segment) return bounds(first.segment, first.share, last.share).variation;
  const double between = variation_before_[last.segment] - variation_before_[first.segment + 1];
  // A difference of long sums is off by the rounding of the sums.
  return bounds(first.segment, first.share, 1.0).variation + between +
         bounds(last.segment, 0.0, last.share).variation +
         0x1.0p-51 * static_cast<double>(segments_.size()) * variation_before_[last.segment];
}

}  // namespace concave_distance::detail
