#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "concave_distance/contact/wrench.h"

namespace concave_distance {

/// How the pressure on the surfaces of one region of overlap follows from the place, at one time. All in A's
/// frame.
struct PressureField {
  double stiffness = 0.0;  ///< Pa/m
  double damping = 0.0;    ///< Pa s/m^2
  RelativeTwist b_in_a;
  /// Unit; places that push B against it carry no pressure: there one body has come out of the other on the
  /// far side. Zero: every place carries some.
  Eigen::Vector3d entered_in_a = Eigen::Vector3d::Zero();

  /// m/s, positive while the surfaces press into each other there. Along the push and not along the way out
  /// of the material, so that damping takes energy at every place, also where that way leads out on the far
  /// side.
  /// @param push_in_a unit, the way B is pushed there
  double approachRate(const Eigen::Vector3d& point_in_a, const Eigen::Vector3d& push_in_a) const {
    return -b_in_a.at(point_in_a).dot(push_in_a);
  }
  /// @param push_in_a unit, the way B is pushed there
  bool carries(const Eigen::Vector3d& push_in_a) const { return !(push_in_a.dot(entered_in_a) < 0.0); }
  /// Pressure over depth, Pa/m, >= 0. @param rate approachRate()
  double perDepth(double rate) const { return std::max(0.0, stiffness + damping * rate); }
};

}  // namespace concave_distance
