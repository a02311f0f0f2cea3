#include "cloud_voxels.h"

#include <vector>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "ros/tf/tf_poses.h"
#include "scene/cloud_bodies.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostNamed = 8;  // bodies in a remark

Eigen::Isometry3d requirePose(const TransformBuffer& transforms, const std::string& target,
                              const CloudReading& reading, double timeout) {
  waitForFrames(transforms, target, reading.frame, reading.stamp, timeout);
  const FrameTransform found = lookUpFrame(*transforms.current(), target, reading.frame, reading.stamp);
  if (found.status == TransformStatus::Ok) return found.target_from_source;
  throw Error("tf", found.message, "publish the sensor's frame at the stamps of its clouds");
}

// Knows the points on the bodies that the cloud leaves out; the remark names those of which it does not.
detail::PointFilter makeFilter(const std::string& frame_of_points, ros::Time stamp, const Scene& scene,
                               const SceneBody& body, const TransformBuffer& transforms, double timeout,
                               std::string& remark) {
  detail::PointFilter filter;
  std::vector<std::string> unknown;
  std::vector<std::string> lost;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout);
  for (const std::size_t index : detail::bodiesLeftOut(scene, body, unknown)) {
    const SceneBody& left_out = scene.bodies[index];
    // A camera may be faster than the robot's joints.
    waitForFrames(transforms, left_out.frame, frame_of_points, stamp,
                  (deadline - ros::WallTime::now()).toSec());
    const FrameTransform found = lookUpFrame(*transforms.current(), left_out.frame, frame_of_points, stamp);
    if (found.status != TransformStatus::Ok) {
      lost.push_back(left_out.name);
      continue;
    }
    filter.add(left_out.mesh, left_out.frame_from_body.inverse(Eigen::Isometry) * found.target_from_source,
               body.cloud->settings->padding);
  }
  if (!lost.empty()) {
    remark = "points on these bodies are not left out, because tf does not say where they were: " +
             detail::listed(lost, kMostNamed);
  }
  if (!unknown.empty()) {
    detail::addRemark(remark, "leave_out names no body of the scene: " + detail::listed(unknown, kMostNamed));
  }
  return filter;
}

// Its distance would be missing without a word.
[[noreturn]] void throwOutside(const Eigen::Vector3d& point, const SceneBody& body) {
  const double reach = body.cloud->settings->voxel_size * VoxelGrid::kLargestIndex;
  throw Error("cloud '" + body.name + "'",
              "a point is " + numberText(point.cwiseAbs().maxCoeff(), 3) + " m from the origin of '" +
                  body.frame + "' along an axis, where voxels reach " + numberText(reach, 3) + " m",
              "give it a range that leaves such points out, or larger voxels");
}

}  // namespace

void detail::addRemark(std::string& remarks, const std::string& remark) {
  if (!remarks.empty()) remarks += "; ";
  remarks += remark;
}

CloudVoxels makeVoxels(const CloudReading& reading, const Scene& scene, const SceneBody& body,
                       const TransformBuffer& transforms, double transform_timeout) {
  const CloudSettings& settings = *body.cloud->settings;
  const Eigen::Isometry3d frame_from_reading =
      requirePose(transforms, body.frame, reading, transform_timeout);
  CloudVoxels made{VoxelGrid(reading.map ? reading.map->size() : settings.voxel_size),
                   reading.map ? frame_from_reading : Eigen::Isometry3d::Identity(), 0, ""};
  const std::string& frame_of_points = reading.map ? reading.frame : body.frame;
  const detail::PointFilter filter =
      makeFilter(frame_of_points, reading.stamp, scene, body, transforms, transform_timeout, made.remark);
  const auto take = [&](const Eigen::Vector3d& point, const VoxelCell& cell) {
    if (made.voxels.contains(cell)) return;
    if (filter.isOnBody(point)) {
      ++made.left_out;
      return;
    }
    if (made.voxels.cells().size() >= settings.largest_voxel_count) {
      throw Error("cloud '" + body.name + "'",
                  "more than " + std::to_string(settings.largest_voxel_count) + " voxels are occupied",
                  "use larger voxels or a shorter range, or raise largest_voxel_count");
    }
    made.voxels.insert(cell);
  };
  VoxelCell cell{};
  for (const Eigen::Vector3d& seen : reading.points) {
    const Eigen::Vector3d point = frame_from_reading * seen;
    if (!made.voxels.locate(point, cell)) throwOutside(point, body);
    take(point, cell);
  }
  if (reading.map) {
    for (const VoxelCell& occupied : reading.map->cells()) {
      const Eigen::Vector3d corner(occupied[0], occupied[1], occupied[2]);
      take(made.voxels.size() * (corner + Eigen::Vector3d::Constant(0.5)), occupied);
    }
  }
  return made;
}

}  // namespace concave_distance
