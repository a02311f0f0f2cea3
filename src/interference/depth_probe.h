#pragma once

#include <Eigen/Geometry>
#include <array>

#include "concave_distance/interference/interference.h"

namespace concave_distance {

/// The greatest depth of a region, and its line.
struct DeepestPoint {
  double depth = 0.0;
  Eigen::Vector3d inside_in_a = Eigen::Vector3d::Zero();   ///< on one body's surface, inside the other
  Eigen::Vector3d surface_in_a = Eigen::Vector3d::Zero();  ///< the closest point of the other's surface
  bool inside_is_of_b = true;
};

/// A point of a facet, A's frame.
struct ProbedPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d exit;   ///< unit, the way for B on which the depth decreases fastest
  double depth;           ///< metres; 0 outside the other body
  TriangleIndex nearest;  ///< of the other body
  bool is_outside;        ///< the other body
};

/// Looks how deep points of an overlap's facets lie, and keeps the deepest.
class DepthProbe {
 public:
  void begin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);
  /// Forgets the deepest point.
  void beginRegion() { deepest_ = {}; }
  ProbedPoint look(const OverlapFacet& facet, const Eigen::Vector3d& point);
  const DeepestPoint& deepest() const { return deepest_; }

  /// No point of the triangle `corners` of a facet is deeper than the farthest of its corners is from one
  /// triangle of the other body: the distance to a convex set is convex.
  double depthBound(const OverlapFacet& facet, const std::array<Eigen::Vector3d, 3>& corners,
                    TriangleIndex nearest) const;

  const BodyMesh& other(const OverlapFacet& facet) const { return *body_[facet.of_b ? 0 : 1]; }
  Eigen::Isometry3d aFromOther(const OverlapFacet& facet) const {
    return facet.of_b ? Eigen::Isometry3d::Identity() : a_from_b_;
  }
  Eigen::Vector3d inOther(const OverlapFacet& facet, const Eigen::Vector3d& point_in_a) const {
    return facet.of_b ? point_in_a : b_from_a_ * point_in_a;
  }
  /// The closest point of the other body's surface, its frame.
  Eigen::Vector3d footInOther(const OverlapFacet& facet, const ProbedPoint& at) const {
    return inOther(facet, at.point + (facet.of_b ? at.depth : -at.depth) * at.exit);
  }

 private:
  const BodyMesh* body_[2] = {nullptr, nullptr};
  Eigen::Isometry3d a_from_b_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d b_from_a_ = Eigen::Isometry3d::Identity();
  TriangleIndex last_nearest_[2];
  DeepestPoint deepest_;
};

/// The way B is pushed on a facet: out of A's surface, into B's.
inline Eigen::Vector3d pushOf(const OverlapFacet& facet) {
  return facet.of_b ? Eigen::Vector3d(-facet.normal_in_a) : facet.normal_in_a;
}

}  // namespace concave_distance
