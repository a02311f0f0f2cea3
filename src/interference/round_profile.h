#pragma once

#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance::detail {

/// Integrals over a round solid from a height of its axis to its top, f the radius at a height. Each is
/// divided by the squared distance from the axis of a point of the surface at that height, which leaves them
/// finite at the top.
struct ProfileTail {
  double volume;  ///< of f^2
  double raised;  ///< of z f^2
  double cubed;   ///< of f^3
  double area;    ///< of the surface but for a cylinder's caps, over 2 pi
};

class RoundProfile {
 public:
  RoundProfile() = default;
  explicit RoundProfile(const RoundShape& shape);

  /// @param height of a point of the surface, @param rho its distance from the axis
  ProfileTail above(double height, double rho) const;
  ProfileTail below(double height, double rho) const;
  /// Returns the integrals over all of the solid, divided by nothing.
  const ProfileTail& whole() const { return whole_; }
  /// Returns a height such that between it and minus it the surface is at least 0.95 radii from the axis.
  double wideHeight() const { return wide_height_; }
  const RoundShape& shape() const { return shape_; }

 private:
  ProfileTail ofEnd(double height, double rho) const;
  ProfileTail ofSide(double height) const;

  RoundShape shape_;
  ProfileTail whole_{};
  double wide_height_ = 0.0;
};

}  // namespace concave_distance::detail
