#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace concave_distance::benchmark {

/// A closed path of joint positions: the periodic cubic spline through waypoints, with continuous velocity
/// and acceleration everywhere.
class JointPath {
 public:
  /// @param times seconds, strictly rising from 0, all below `period`, at least three
  /// @param waypoints one row a time, one column a joint (radians or metres)
  JointPath(std::vector<double> times, Eigen::MatrixXd waypoints, double period);

  double period() const { return period_; }

  /// Positions `time` seconds after the start; any finite time, the path repeats.
  Eigen::VectorXd at(double time) const;

 private:
  std::vector<double> times_;
  Eigen::MatrixXd waypoints_;
  Eigen::MatrixXd velocities_;  ///< at the waypoints
  double period_;
};

struct NamedJointPath {
  std::vector<std::string> joints;
  JointPath path;
};

/// Reads `t,<joint>,<joint>,...`; the last row repeats the first one and gives the period.
/// @throws Error when it does not, for fewer than four rows, or times that do not rise from 0
NamedJointPath readJointPath(const std::string& path);

}  // namespace concave_distance::benchmark
