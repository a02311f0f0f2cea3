#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace concave_distance::detail {

/// Answers how far points of one body have moved as seen from the other between two poses: what every bound
/// that is kept from pose to pose asks, since no distance changes by more. The proof, the cones and the
/// basins each ask from the pose that they last looked at.
class PairMotion {
 public:
  /// @param rotation,offset of the body that moves: a point x of it is seen at rotation * x + offset
  /// @param rounding metres, what the displacement of a point may be off
  PairMotion(const Eigen::Matrix3d& rotation_before, const Eigen::Vector3d& offset_before,
             const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset, double rounding = 0.0)
      : turn_(rotation - rotation_before),
        shift_(offset - offset_before),
        // The largest stretch of a difference of two rotations by an angle t is 2 sin(t / 2): its Frobenius
        // norm over sqrt(2).
        stretch_(turn_.norm() * 0.70710678118654757),
        rounding_(rounding) {}
  PairMotion(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after)
      : PairMotion(before.linear(), before.translation(), after.linear(), after.translation()) {}

  bool isStill() const { return turn_.isZero(0.0) && shift_.isZero(0.0); }
  /// Metres that no point moves farther by than one at a metre from it does, because of the turn.
  double stretch() const { return stretch_; }
  /// Radians between the two rotations, but for rounding.
  double angle() const { return 2.0 * std::asin(std::min(1.0, 0.5 * stretch_)); }
  Eigen::Vector3d of(const Eigen::Vector3d& point) const { return turn_ * point + shift_; }
  /// Metres; no point within `radius` of `centre` has moved farther.
  double largestWithin(const Eigen::Vector3d& centre, double radius) const {
    return of(centre).norm() + stretch_ * radius + rounding_;
  }
  /// Metres; no point of the box has moved farther: the norm of an affine map is convex, so that it is
  /// largest at a corner.
  double largestIn(const Eigen::AlignedBox3d& box) const {
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      largest = std::max(largest,
                         of(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))).squaredNorm());
    }
    return std::sqrt(largest) + rounding_;
  }

 private:
  Eigen::Matrix3d turn_;
  Eigen::Vector3d shift_;
  double stretch_;
  double rounding_;
};

}  // namespace concave_distance::detail
