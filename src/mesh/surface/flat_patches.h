#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "edge_table.h"

namespace concave_distance::detail {

/// Plane coordinates: the first axis along the patch's longest border edge, metres. The second is of unit
/// length too unless the patch is so flat that it is seen stretched.
struct PatchFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d first_axis = Eigen::Vector3d::Zero();
  Eigen::Vector3d second_axis = Eigen::Vector3d::Zero();

  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {first_axis.dot(point - origin), second_axis.dot(point - origin)};
  }
};

struct FlatPatches {
  std::vector<std::uint32_t> patch_of_triangle;
  std::vector<std::vector<std::uint32_t>> triangles_of_patch;
  std::vector<PatchFrame> frames;
};

/// Joins triangles over edges of two triangles wound alike while their vertices stay within `flatness` metres
/// of the plane of the patch's first and largest triangle and they face its way. O(n log n).
FlatPatches findFlatPatches(const SurfaceMesh& surface, const EdgeTable& edges, double flatness);

/// Joins whole patches over such edges while all of their vertices stay within `flatness` metres of the plane
/// of the joined patch's largest part: triangles that lie in one plane up to rounding are not parted where a
/// plane close by meets theirs. O(triangles) for each patch that a patch is compared with.
FlatPatches joinFlatPatches(const SurfaceMesh& surface, const EdgeTable& edges, const FlatPatches& patches,
                            double flatness);

}  // namespace concave_distance::detail
