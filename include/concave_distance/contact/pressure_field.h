#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "concave_distance/contact/wrench.h"

namespace concave_distance {

/// Gives the pressure on the surfaces of one region of overlap at any place, at one time. All members are in
/// A's frame.
struct PressureField {
  double stiffness = 0.0;  ///< Pa/m
  double damping = 0.0;    ///< Pa s/m^2
  RelativeTwist b_in_a;
  /// Unit; places that push B against it carry no pressure: there one body has come out of the other on the
  /// far side. Zero: every place carries some.
  Eigen::Vector3d entered_in_a = Eigen::Vector3d::Zero();

  /// m/s, positive while the surfaces press into each other there: along the push, so that damping takes
  /// energy at every place, also where the shortest way out leads to the far side; times the square of their
  /// cosine, so that a side that slides along the other body is not damped.
  /// @param push_in_a unit, the way B is pushed there
  /// @param exit_in_a unit, the shortest way out there, of either sign
  double approachRate(const Eigen::Vector3d& point_in_a, const Eigen::Vector3d& push_in_a,
                      const Eigen::Vector3d& exit_in_a) const {
    const double share = push_in_a.dot(exit_in_a);
    return -share * share * b_in_a.at(point_in_a).dot(push_in_a);
  }
  /// @param push_in_a unit, the way B is pushed there
  bool carries(const Eigen::Vector3d& push_in_a) const { return !(push_in_a.dot(entered_in_a) < 0.0); }
  /// Pressure over depth, Pa/m, >= 0. @param rate approachRate()
  double perDepth(double rate) const { return std::max(0.0, stiffness + damping * rate); }
};

}  // namespace concave_distance
