#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "triangle_tree.h"

namespace concave_distance {

/// A box with its own axes (an OBB). Metres.
struct OrientedBox {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;  ///< columns, unit and at right angles but for rounding
  Eigen::Vector3d half;  ///< half extents along the axes, >= 0
};

/// Hierarchy of oriented boxes over a surface's triangles, four to a node, laid out for vector instructions.
/// Coordinates are relative to `origin` (the centre of the bounding box), so that rounding is relative to the
/// body and not to its frame; boxes hold their triangles in spite of rounding: halves are widened by
/// kBoxMargin times `reach`. Built once from the triangle tree in O(n log n). Immutable. Why oriented boxes
/// and why four: doc/hierarchy.md.
class BoundingVolumeHierarchy {
 public:
  static constexpr std::size_t kWidth = 4;
  static constexpr std::uint32_t kNoChild = 0xffffffffU;
  static constexpr std::uint32_t kLeafFlag = 0x80000000U;
  /// 32 machine epsilons: for corners projected onto axes that are orthonormal to a few of them.
  static constexpr double kBoxMargin = 0x1.0p-47;

  /// Boxes of up to four children; lane by lane. Unused lanes hold kNoChild and repeat the last box.
  struct alignas(32) Node {
    double centre[3][kWidth];
    double axes[3][3][kWidth];  ///< [axis][coordinate]
    double half[3][kWidth];
    std::uint32_t child[kWidth];  ///< of a node, or of a leaf with kLeafFlag
  };

  /// The same boxes in single precision, lengths relative to `reach`, each number rounded once.
  struct alignas(16) SingleNode {
    float centre[3][kWidth];
    float axes[3][3][kWidth];
    float half[3][kWidth];
    float squared_size[kWidth];  ///< squared half diagonal
    std::uint32_t child[kWidth];
  };

  /// Holds up to four triangles; unused lanes repeat the last one.
  struct alignas(32) Leaf {
    double corner[3][3][kWidth];  ///< [corner][coordinate]
    TriangleIndex triangle[kWidth];
    std::uint32_t count;
  };

  /// A slot says where a box stands: node * kWidth + lane.
  using Slot = std::uint32_t;
  static constexpr Slot kRoot = 0;  ///< the box of the whole surface

  BoundingVolumeHierarchy() = default;
  BoundingVolumeHierarchy(const SurfaceMesh& mesh, const TriangleTree& tree);

  const Eigen::Vector3d& origin() const { return origin_; }
  /// Returns the largest distance of a vertex from `origin`, rounded up; metres.
  double reach() const { return reach_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<SingleNode>& singleNodes() const { return single_nodes_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  std::uint32_t child(Slot slot) const { return single_nodes_[slot / kWidth].child[slot % kWidth]; }
  OrientedBox box(Slot slot) const;
  /// Returns the boxes of the first two levels, at most 21, the whole surface first: each holds what lies
  /// below the nodes of its subtree. How far any point of a node has moved is bounded by its subtree.
  const std::vector<Slot>& subtrees() const { return subtrees_; }
  std::uint8_t subtreeOfNode(std::uint32_t node) const { return subtree_of_node_[node]; }

 private:
  void roundNodes();
  void chooseSubtrees();

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double reach_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<SingleNode> single_nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Slot> subtrees_;
  std::vector<std::uint8_t> subtree_of_node_;
};

}  // namespace concave_distance
