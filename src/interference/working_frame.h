#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "perturbed_predicates.h"

namespace concave_distance::detail {

/// Both bodies' vertices in one frame: A's axes, the origin near A, lengths scaled by a power of two so that
/// the larger body measures between 1 and 2. A vertex is computed when it is first asked for, B's with one
/// rounding each way, always to the same bits. What the exact predicates are exact for are these points.
class WorkingFrame {
 public:
  void reset(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

  const BodyMesh& body(Side side) const { return *body_[at(side)]; }
  const SurfaceMesh& surface(Side side) const { return body(side).surface(); }
  const Eigen::Vector3d& point(Side side, NodeIndex vertex) {
    const std::size_t s = at(side);
    if (stamps_[s][vertex.value] != stamp_) computePoint(s, vertex);
    return points_[s][vertex.value];
  }
  Corners corners(Side side, TriangleIndex triangle) {
    const TriangleNodes& nodes = surface(side).triangle(triangle);
    return {&point(side, nodes[0]), &point(side, nodes[1]), &point(side, nodes[2])};
  }
  /// Unit, or zero where a triangle has no area.
  Eigen::Vector3d normal(Side side, TriangleIndex triangle) const {
    const Eigen::Vector3d& n = body(side).topology().triangle_normals[triangle.value];
    return side == Side::A ? n : Eigen::Vector3d(rotation_ * n);
  }
  /// Returns a point of the working frame in the frame of a body (metres), for descending its tree.
  Eigen::Vector3d pointInBody(Side side, const Eigen::Vector3d& point) const;
  Eigen::Vector3d pointInA(const Eigen::Vector3d& point) const { return point / scale_ + centre_[0]; }

  double scale() const { return scale_; }  ///< working lengths a metre
  /// Returns how far roundings may move a vertex of B, which depths are sure to; metres.
  double roundingBound() const { return rounding_bound_; }
  const Eigen::Isometry3d& aFromB() const { return a_from_b_; }

 private:
  void computePoint(std::size_t side, NodeIndex vertex);

  const BodyMesh* body_[2] = {nullptr, nullptr};
  Eigen::Isometry3d a_from_b_ = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre_[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();  ///< of B's centre from A's, metres
  double scale_ = 1.0;
  double rounding_bound_ = 0.0;
  std::uint32_t stamp_ = 0;
  std::vector<Eigen::Vector3d> points_[2];
  std::vector<std::uint32_t> stamps_[2];
};

}  // namespace concave_distance::detail
