#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace concave_distance::demo {

/// Poses at rising times, straight and at constant angular speed in between.
class PosePath {
 public:
  /// @param times seconds, strictly rising, as many as poses and at least one
  PosePath(std::vector<double> times, std::vector<Eigen::Isometry3d> poses);

  double startTime() const { return times_.front(); }
  double endTime() const { return times_.back(); }
  double duration() const { return endTime() - startTime(); }

  /// The pose at `time` seconds; the first or the last one outside the path's times.
  Eigen::Isometry3d at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<Eigen::Isometry3d> poses_;
};

/// Reads a poses.csv as distance_query takes it (`t,x,y,z,qx,qy,qz,qw`).
/// @throws Error for other columns, times that do not rise, a quaternion whose norm is not within 1e-3 of 1
PosePath readPosePath(const std::string& path);

/// Forwards through [0, duration] and backwards again, without end: the time on the path after `elapsed`
/// seconds, with a rest of `pause` seconds at either end.
double pingPong(double elapsed, double duration, double pause);

}  // namespace concave_distance::demo
