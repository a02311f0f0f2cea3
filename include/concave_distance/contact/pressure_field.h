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

  /// m/s, positive while it grows.
  /// @param exit_in_a unit, the way for B on which the depth decreases fastest
  double depthRate(const Eigen::Vector3d& point_in_a, const Eigen::Vector3d& exit_in_a) const {
    return -b_in_a.at(point_in_a).dot(exit_in_a);
  }
  /// @param push_in_a unit, the way B is pushed there
  bool carries(const Eigen::Vector3d& push_in_a) const { return !(push_in_a.dot(entered_in_a) < 0.0); }
  /// Pressure over depth, Pa/m, >= 0, where the depth grows by `depth_rate`.
  double perDepth(double depth_rate) const { return std::max(0.0, stiffness + damping * depth_rate); }
};

}  // namespace concave_distance
