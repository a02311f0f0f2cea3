#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// Depth below a plane of the other body's surface: offset - out . point. A's frame.
struct DepthPlane {
  Eigen::Vector3d out;   ///< unit, out of the other body
  Eigen::Vector3d exit;  ///< unit, the way for B on which the depth decreases
  double offset;
  TriangleIndex triangle;  ///< of the other body

  double depth(const Eigen::Vector3d& point) const { return offset - out.dot(point); }
};

/// Planes of the other body's triangles near a part of a facet. Where these are convex the depth below them
/// is the least one.
class DepthPlanes {
 public:
  /// Begins with another body: for facets of B that is A, and the reverse.
  void begin(const BodyMesh& other, const Eigen::Isometry3d& a_from_other, bool facet_is_of_b);
  void clear() { planes_.clear(); }
  void add(TriangleIndex triangle);
  /// The same, and of the triangles across convex edges that `closest` (on the triangle, other body's frame)
  /// lies on: there rounding decides which triangle is found.
  void addAround(TriangleIndex triangle, const Eigen::Vector3d& closest);
  std::size_t size() const { return planes_.size(); }
  /// Metres, >= 0; infinite without planes.
  double leastDepth(const Eigen::Vector3d& point) const;

  /// The parts of a triangle below which each plane is the lowest: visit(plane, convex polygon).
  template <typename Visit>
  void forEachPart(const std::array<Eigen::Vector3d, 3>& triangle, const Visit& visit) {
    for (const DepthPlane& plane : planes_) {
      keepBelow(plane, triangle);
      if (polygon_.size() > 2) visit(plane, polygon_);
    }
  }

 private:
  void keepBelow(const DepthPlane& plane, const std::array<Eigen::Vector3d, 3>& triangle);
  void cutOff(const DepthPlane& plane, const DepthPlane& other);

  const BodyMesh* other_ = nullptr;
  Eigen::Isometry3d a_from_other_ = Eigen::Isometry3d::Identity();
  double exit_sign_ = 1.0;
  std::vector<DepthPlane> planes_;
  std::vector<Eigen::Vector3d> polygon_;
  std::vector<Eigen::Vector3d> clipped_;
};

}  // namespace concave_distance
