#include "pose_path.h"

#include <algorithm>
#include <cmath>

#include "concave_distance/base/error.h"
#include "csv_table.h"

namespace concave_distance::demo {
namespace {

// As distance_query's contract has it.
constexpr double kQuaternionTolerance = 1e-3;

}  // namespace

PosePath::PosePath(std::vector<double> times, std::vector<Eigen::Isometry3d> poses)
    : times_(std::move(times)), poses_(std::move(poses)) {}

Eigen::Isometry3d PosePath::at(double time) const {
  if (time <= times_.front()) return poses_.front();
  if (time >= times_.back()) return poses_.back();
  const auto after = std::upper_bound(times_.begin(), times_.end(), time);
  const auto next = static_cast<std::size_t>(after - times_.begin());
  const std::size_t last = next - 1;
  const double part = (time - times_[last]) / (times_[next] - times_[last]);
  const Eigen::Quaterniond rotation_last(poses_[last].linear());
  const Eigen::Quaterniond rotation_next(poses_[next].linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation_last.slerp(part, rotation_next).normalized().toRotationMatrix();
  pose.translation() = (1.0 - part) * poses_[last].translation() + part * poses_[next].translation();
  return pose;
}

PosePath readPosePath(const std::string& path) {
  const CsvTable table = readCsv(path);
  if (table.columns != std::vector<std::string>{"t", "x", "y", "z", "qx", "qy", "qz", "qw"}) {
    throw Error(path, "the columns are others than a pose's", "begin with the line t,x,y,z,qx,qy,qz,qw");
  }
  std::vector<Eigen::Isometry3d> poses;
  for (const std::vector<double>& row : table.rows) {
    const Eigen::Quaterniond rotation(row[7], row[4], row[5], row[6]);
    if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionTolerance)) {
      throw Error(path,
                  "the quaternion at t = " + std::to_string(row[0]) + " s has the norm " +
                      std::to_string(rotation.norm()),
                  "give unit quaternions");
    }
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() = Eigen::Vector3d(row[1], row[2], row[3]);
    poses.push_back(pose);
  }
  return {readRisingTimes(table, path), std::move(poses)};
}

double pingPong(double elapsed, double duration, double pause) {
  const double leg = duration + pause;
  const double phase = std::fmod(std::max(elapsed, 0.0), 2.0 * leg);
  return phase < leg ? std::min(phase, duration) : std::max(duration - (phase - leg), 0.0);
}

}  // namespace concave_distance::demo
