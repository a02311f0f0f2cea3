#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "cloud_message.h"
#include "concave_distance/scene/scene.h"
#include "ros/tf/transform_buffer.h"

namespace concave_distance {

/// Holds what a cloud's body is made of.
struct CloudVoxels {
  VoxelGrid voxels;
  Eigen::Isometry3d frame_from_voxels;  ///< of the cloud's frame
  std::size_t left_out = 0;             ///< points or cells on bodies that do not count
  std::string remark;                   ///< what could not be left out; empty: nothing
};

/// Returns the voxels that a reading occupies, without those on bodies that the cloud leaves out. It waits
/// for tf at the reading's stamp. @param body of the cloud, in `scene`. @param transform_timeout seconds in
/// all
/// @throws Error when tf does not say where the sensor was, a point is outside of the grid, or there are too
///         many voxels
CloudVoxels makeVoxels(const CloudReading& reading, const Scene& scene, const SceneBody& body,
                       const TransformBuffer& transforms, double transform_timeout);

namespace detail {
/// Appends a remark, after a semicolon where there is one already.
void addRemark(std::string& remarks, const std::string& remark);
}  // namespace detail

}  // namespace concave_distance
