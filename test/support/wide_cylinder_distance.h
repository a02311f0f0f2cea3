#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"
#include "support/round_bodies.h"

namespace concave_distance::test {

using WideVector = Eigen::Matrix<long double, 3, 1>;

/// Distance of two cylinders in long double, by another way than the package's: two cylinders apart are as
/// far apart as one of the four rims is from the other solid, or as their axes less the radii where the
/// closest points of the axes are inside both. Not above 0 where they overlap.
class WideCylinderDistance {
 public:
  WideCylinderDistance(const RoundShape& a, const RoundShape& b, const Eigen::Isometry3d& a_from_b)
      : a_(a),
        b_(b),
        turn_(a_from_b.linear().cast<long double>()),
        centre_(a_from_b.translation().cast<long double>()) {}

  long double find() const {
    long double least = betweenAxes();
    for (const int end : {-1, 1}) {
      least = std::min(least, ofRim([&](long double angle) {
                         return wideSignedDistance(a_, WideVector(centre_ + turn_ * onRim(b_, end, angle)));
                       }));
      least = std::min(least, ofRim([&](long double angle) {
                         const WideVector away = onRim(a_, end, angle) - centre_;
                         return wideSignedDistance(b_, WideVector(turn_.transpose() * away));
                       }));
    }
    return least;
  }

 private:
  static WideVector onRim(const RoundShape& shape, int end, long double angle) {
    const auto r = static_cast<long double>(shape.radius);
    return {r * std::cos(angle), r * std::sin(angle), end * static_cast<long double>(shape.half_length)};
  }

  /// Every local minimum of the samples is searched.
  template <typename Function>
  static long double ofRim(const Function& f) {
    constexpr std::size_t kSamples = 96;
    constexpr long double kStep = 2.0L * kPi / kSamples;
    std::array<long double, kSamples> values{};
    for (std::size_t i = 0; i < kSamples; ++i) values[i] = f(kStep * static_cast<long double>(i));
    long double least = values[0];
    for (std::size_t i = 0; i < kSamples; ++i) {
      if (values[i] > values[(i + 1) % kSamples] || values[i] > values[(i + kSamples - 1) % kSamples])
        continue;
      const long double middle = kStep * static_cast<long double>(i);
      least = std::min(least, between(f, middle - kStep, middle + kStep));
    }
    return least;
  }

  template <typename Function>
  static long double between(const Function& f, long double low, long double high) {
    long double least = f(low);
    for (int i = 0; i < 110; ++i) {
      const long double l = low + (high - low) / 3;
      const long double r = high - (high - low) / 3;
      const long double at_l = f(l);
      const long double at_r = f(r);
      least = std::min({least, at_l, at_r});
      (at_l < at_r ? high : low) = at_l < at_r ? r : l;
    }
    return least;
  }

  long double betweenAxes() const {
    const WideVector axis = turn_.col(2);
    const WideVector cross(-axis.y(), axis.x(), 0.0L);
    const long double squared = cross.squaredNorm();
    if (!(squared > 0.0L)) return 1e30L;
    const long double on_b = -(centre_.x() * axis.x() + centre_.y() * axis.y()) / squared;
    const long double on_a = centre_.z() + on_b * axis.z();
    if (std::abs(on_a) > static_cast<long double>(a_.half_length) ||
        std::abs(on_b) > static_cast<long double>(b_.half_length))
      return 1e30L;
    return std::abs(centre_.dot(cross)) / std::sqrt(squared) - static_cast<long double>(a_.radius) -
           static_cast<long double>(b_.radius);
  }

  const RoundShape& a_;
  const RoundShape& b_;
  Eigen::Matrix<long double, 3, 3> turn_;
  WideVector centre_;
};

}  // namespace concave_distance::test
