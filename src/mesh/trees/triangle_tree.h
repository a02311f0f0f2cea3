#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Subtrees of more triangles are built as tasks of their own; smaller ones would copy more than they gain.
inline constexpr std::uint32_t kParallelSubtree = 32768;

/// Axis-aligned box hierarchy over a surface's triangles, in the body frame; boxes are rounded outwards.
/// Built once in O(n log n) (surface area heuristic), 2 n nodes at most.
class TriangleTree {
 public:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first =
        0;  ///< inner: index of the second child (the first is next to the node); leaf: first entry
    std::uint32_t count = 0;  ///< 0 for an inner node, else triangles in the leaf
  };
  TriangleTree() = default;
  explicit TriangleTree(const SurfaceMesh& mesh);
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Returns the triangles in leaf order: a leaf holds order()[first .. first + count).
  const std::vector<TriangleIndex>& order() const { return order_; }

 private:
  std::vector<Node> nodes_;
  std::vector<TriangleIndex> order_;
};

/// Returns true when some triangle meets the open segment (a, b), body frame, shortened at both ends by
/// `margin` metres so that the surface an end lies on does not count.
bool segmentHits(const TriangleTree& tree, const SurfaceMesh& mesh, const Eigen::Vector3d& a,
                 const Eigen::Vector3d& b, double margin);

/// Returns a triangle that does, or kNoTriangle.
/// @param first tried before the others, unless it is kNoTriangle
TriangleIndex findHit(const TriangleTree& tree, const SurfaceMesh& mesh, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b, double margin, TriangleIndex first);

/// Returns true when the point lies inside the closed shells of an outward-oriented mesh: signed crossings of
/// three slanted rays, majority. Shells that are open count as nothing.
bool containsPoint(const TriangleTree& tree, const SurfaceMesh& mesh,
                   const std::vector<bool>& shell_is_closed,
                   const std::vector<std::uint32_t>& shell_of_triangle, const Eigen::Vector3d& point);

}  // namespace concave_distance
