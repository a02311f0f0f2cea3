#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "concave_distance/scene/simulation_settings.h"

namespace concave_distance {

/// Velocity of a frame: of its origin, and angular; world axes.
struct FrameTwist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< rad/s

  /// Returns the velocity of the point of that frame that is `offset` from its origin, world axes.
  Eigen::Vector3d at(const Eigen::Vector3d& offset) const { return linear + angular.cross(offset); }
};

/// A pose over time: straight and at constant speed from one given pose to the next, turning about a fixed
/// axis meanwhile; at rest before the first and after the last.
class PosePath {
 public:
  /// @param poses at least one, times ascending
  explicit PosePath(std::vector<TimedPose> poses);

  double startTime() const { return poses_.front().time; }
  double endTime() const { return poses_.back().time; }
  Eigen::Isometry3d poseAt(double time) const;
  /// Constant over each piece. @param inside a time within the piece that is meant
  FrameTwist twistAt(double inside) const;
  /// The first given time after `time`; infinite after the last.
  double nextChange(double time) const;

 private:
  std::size_t pieceOf(double time) const;  ///< last pose not after `time`; the number of poses: before all
  std::vector<TimedPose> poses_;
};

}  // namespace concave_distance
