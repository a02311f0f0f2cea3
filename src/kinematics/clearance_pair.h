#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/scene/scene.h"
#include "displacement_bound.h"
#include "distance/bound/certificate.h"
#include "relative_path.h"

namespace concave_distance::detail {

/// A body as it is solved, for all its pairs.
struct ClearanceBody {
  std::shared_ptr<const BodyMesh> mesh;              ///< BodyMesh::asSolved()
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of that mesh's frame, body frame
  BodyBounds bounds;                                 ///< of that mesh
  BoxCorners corners{};
  BodyPath path;  ///< of that mesh's frame
};

/// Two bodies that the motion moves against each other.
struct ClearancePair {
  std::size_t body_a = 0;  ///< in Scene::bodies
  std::size_t body_b = 0;
  const ClearanceBody* a = nullptr;
  const ClearanceBody* b = nullptr;
  double margin = 0.0;  ///< metres, of both
  double error = 0.0;   ///< metres, of any pose
  RelativePath path;
};

/// Holds what is known of a pair at one moment.
struct ClearanceSample {
  double moment = 0.0;
  double lower = -std::numeric_limits<double>::infinity();    ///< metres, proven; margins taken off
  double distance = std::numeric_limits<double>::infinity();  ///< metres, of two points; not below 0
  bool is_certified = false;                                  ///< else the bound is that of boxes, or nothing
  bool is_apart = false;     ///< proven that neither body holds a part of the other
  TrianglePair triangles{};  ///< where it is certified, as the points
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Zero();  ///< frame of the mesh as it is solved
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Zero();
};

/// How exact a sample is to be.
struct SampleRequest {
  double aim = 0.0;        ///< metres: only what a bound is above this is of use
  double need = 0.0;       ///< metres above `aim` that would be enough
  double tolerance = 0.0;  ///< metres, where the distance is not above `aim`
  bool allows_boxes = true;
};

/// Buffers of one thread.
struct ClearanceWorkspace {
  MotionSpan span;
  RelativePose pose;
  RelativePose other_pose;
  CertificateWorkspace certificate;
  std::size_t queries = 0;
  std::size_t box_queries = 0;
};

/// Bounds the distance of a pair by its boxes, at workspace.pose.
ClearanceSample sampleByBoxes(const ClearancePair& pair, double moment, ClearanceWorkspace& workspace);

/// Bounds the distance of a pair at workspace.pose: by its boxes where they do, else by a certified distance.
/// @param starts triangles that may be the nearest
/// @param is_apart known to be true beforehand
ClearanceSample sampleAt(const ClearancePair& pair, double moment, const SampleRequest& request,
                         const TrianglePair* starts, std::size_t start_count, bool is_apart,
                         ClearanceWorkspace& workspace, WorkLimit& limit);

}  // namespace concave_distance::detail
