#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/base/eigen_alignment.h"
#include "concave_distance/base/indices.h"

namespace concave_distance {

using TriangleNodes = std::array<NodeIndex, 3>;

/// Triangles as they come from a file: unwelded, of any winding, possibly degenerate. Metres, body frame.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// An immutable triangle surface in its body's frame, metres. Every corner index is in range and every
/// coordinate finite; triangles may still be degenerate (see repairMesh).
class SurfaceMesh {
 public:
  SurfaceMesh() = default;
  /// @param where named in the error, e.g. the file the surface came from
  /// @throws Error when there is no triangle, an index is out of range or a coordinate is not finite
  SurfaceMesh(std::vector<Eigen::Vector3d> vertices, std::vector<TriangleNodes> triangles,
              const std::string& where);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<TriangleNodes>& triangles() const { return triangles_; }
  std::size_t vertexCount() const { return vertices_.size(); }
  std::size_t triangleCount() const { return triangles_.size(); }
  const Eigen::Vector3d& vertex(NodeIndex node) const { return vertices_[node.value]; }
  const TriangleNodes& triangle(TriangleIndex triangle) const { return triangles_[triangle.value]; }
  const Eigen::Vector3d& corner(TriangleIndex triangle, int corner) const {
    return vertices_[triangles_[triangle.value][static_cast<std::size_t>(corner)].value];
  }
  const Eigen::AlignedBox3d& boundingBox() const { return bounding_box_; }
  /// Length of the bounding box's diagonal, metres.
  double diameter() const { return bounding_box_.isEmpty() ? 0.0 : bounding_box_.diagonal().norm(); }

 private:
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<TriangleNodes> triangles_;
  Eigen::AlignedBox3d bounding_box_;
};

}  // namespace concave_distance
