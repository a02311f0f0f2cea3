#include "query_poses.h"

#include <cmath>

#include "base/constants.h"
#include "base/csv_table.h"
#include "base/csv_writer.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "tracking/rigid_pose.h"

namespace concave_distance {

std::vector<QueryPose> readQueryPoses(const std::string& path) {
  const CsvTable table = readCsv(path, "t,x,y,z,qx,qy,qz,qw", kMatrixPoseHeader);
  const bool has_matrices = table.columns.size() > 8;
  std::vector<QueryPose> poses;
  poses.reserve(table.rowCount());
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const auto v = [&](std::size_t column) { return table.at(row, column); };
    if (!std::isfinite(v(0))) {
      throw Error(path + ":" + std::to_string(table.lines[row]), "column t is '" + numberText(v(0)) + "'",
                  "give each line a time in seconds");
    }
    QueryPose& pose = poses.emplace_back();
    pose.time = v(0);
    pose.position = {v(1), v(2), v(3)};
    if (has_matrices) {
      pose.rotation.emplace();
      *pose.rotation << v(4), v(5), v(6), v(7), v(8), v(9), v(10), v(11), v(12);
    } else {
      pose.quaternion = {v(4), v(5), v(6), v(7)};
    }
  }
  return poses;
}

std::string matrixPosesText(const std::vector<TimedPose>& poses) {
  TextStream text;
  text << kMatrixPoseHeader << '\n';
  CsvWriter line(text);
  for (const TimedPose& timed : poses) {
    line << timed.time << Eigen::Vector3d(timed.pose.translation());
    for (int row = 0; row < 3; ++row) line << Eigen::Vector3d(timed.pose.linear().row(row));
    line.endLine();
  }
  return text.str();
}

std::vector<TimedPose> readPosePath(const std::string& path) {
  std::vector<TimedPose> poses;
  for (const QueryPose& query : readQueryPoses(path)) {
    const std::optional<Eigen::Isometry3d> pose = poseOf(query);
    if (!pose || (!poses.empty() && !(query.time > poses.back().time))) {
      throw Error(path,
                  "the pose at t = " + numberText(query.time) + " is not a pose, or not after the one before",
                  "finite numbers, unit quaternions and ascending times are needed");
    }
    poses.push_back({query.time, *pose});
  }
  if (poses.empty()) throw Error(path, "it holds no pose", "give one at least");
  return poses;
}

std::optional<Eigen::Isometry3d> poseOf(const QueryPose& query) {
  if (!query.position.allFinite() || query.position.cwiseAbs().maxCoeff() > kLargestCoordinate)
    return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = query.position;
  if (query.rotation) {
    pose.linear() = *query.rotation;
    return rigidPose(pose) ? std::optional<Eigen::Isometry3d>(pose) : std::nullopt;
  }
  const double norm = query.quaternion.norm();
  if (!(std::abs(norm - 1.0) <= kUnitTolerance)) return std::nullopt;
  pose.linear() = Eigen::Quaterniond(Eigen::Vector4d(query.quaternion / norm)).toRotationMatrix();
  return pose;
}

}  // namespace concave_distance
