#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Returns whether a body's size limits its margin: a robot's is for all its links, also those that are
/// smaller, and how large a cloud will be nobody knows.
inline bool limitsMargin(const SceneBody& body) {
  return !body.is_robot_link && !body.cloud;
}

/// Returns whether a body is a cloud that has come, and nothing is there: it is infinitely far from all.
inline bool isEmptyCloud(const SceneBody& body) {
  return body.cloud && body.cloud->stamp && !body.cloud->hasVoxels();
}

/// Returns whether lists of all pairs' niches have those of a body's pairs: of a cloud on request.
inline bool hasNiches(const SceneBody& body) {
  return !body.cloud || body.cloud->settings->niches;
}

/// Returns the bodies of which no point counts in a cloud, places in scene.bodies: links of robots, what is
/// attached to one, and what the cloud's `leave_out` names. @param unknown gets names that no body has
std::vector<std::size_t> bodiesLeftOut(const Scene& scene, const SceneBody& cloud,
                                       std::vector<std::string>& unknown);

/// Tells the points on bodies from the others.
class PointFilter {
 public:
  /// @param body_from_points rigid. @param padding metres
  void add(std::shared_ptr<const BodyMesh> body, const Eigen::Isometry3d& body_from_points, double padding);
  /// Returns whether a point is inside one of the bodies or no farther than the padding from it. Round solids
  /// count with the largest distance of their mesh from them, so that none of their points is missed.
  bool isOnBody(const Eigen::Vector3d& point) const;

 private:
  struct Body {
    std::shared_ptr<const BodyMesh> mesh;
    Eigen::Isometry3d body_from_points;
    Eigen::AlignedBox3d reach;  ///< of the points that can be on it, body frame
    double padding;
  };
  std::vector<Body> bodies_;
};

/// Returns the body's mesh for a cloud of these voxels, made on the calling thread alone.
std::shared_ptr<const BodyMesh> makeCloudMesh(const std::string& name, const VoxelGrid& voxels);

/// Gives a cloud's body what came last. @param mesh of its voxels; nullptr: there are none
void takeCloud(SceneBody& body, CloudState state, std::shared_ptr<const BodyMesh> mesh,
               const Eigen::Isometry3d& frame_from_body);

}  // namespace concave_distance::detail
