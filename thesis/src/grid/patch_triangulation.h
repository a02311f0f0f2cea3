#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "mesh/surface/editable_mesh.h"
#include "mesh/surface/flat_patches.h"
#include "mesh/surface/plane_geometry.h"

namespace concave_distance::detail {

/// A point to become a node: where, and on which original triangle.
struct GridPoint {
  Eigen::Vector3d position;
  TriangleIndex original_triangle;
};

/// Constrained Delaunay triangulation of the flat patches of a mesh (whose tags are the patches). An edge is
/// interior when its two triangles belong to one patch; all others are kept. Every flip is checked: a
/// triangulation stays one even where rounding decides.
class PatchTriangulation {
 public:
  PatchTriangulation(EditableMesh& mesh, const std::vector<PatchFrame>& frames,
                     std::vector<TriangleIndex> original_triangle_of_node);

  bool isInterior(std::size_t edge) const;

  /// To be called when the border edges have been divided, before anything is flipped: from here on no flip
  /// joins two nodes that an edge joins already. (Sheets may touch along a line that is an edge of one only.)
  void rememberEdges();

  /// Flips interior edges until the given ones and all they disturb are Delaunay; appends the edges that
  /// changed to `changed`.
  void legalise(std::vector<std::uint32_t>& edges, std::vector<std::uint32_t>& changed);

  /// Splits an edge; nothing is flipped yet.
  void splitEdge(std::size_t edge, const GridPoint& point);

  /// The edges of the triangles that the last split made or changed.
  void appendTouchedEdges(std::vector<std::uint32_t>& edges) const;

  /// Notes a point inside a triangle for insertPending().
  void addPending(std::uint32_t triangle, const GridPoint& point);

  /// Inserts all points noted, but for those closer than `least_distance` to a corner of their triangle. In a
  /// shuffled order, which makes the expected cost O(n log n) (Clarkson and Shor 1989); the same every time.
  void insertPending(double least_distance);

  const std::vector<TriangleIndex>& originalTriangleOfNode() const { return original_triangle_of_node_; }

 private:
  struct Pending {
    GridPoint point;
    std::uint32_t triangle;   ///< that it lies in now
    std::uint32_t following;  ///< in the triangle's list
    bool done;
  };
  Eigen::Vector2d project(std::uint32_t patch, NodeIndex node) const;
  PlaneTriangle project(std::uint32_t triangle) const;
  bool shouldFlip(std::size_t edge) const;
  bool areJoined(NodeIndex c, NodeIndex d) const;
  void notePending(std::uint32_t triangle, std::uint32_t pending);
  void insertPoint(std::uint32_t triangle, const GridPoint& point);
  /// Hands the points noted for these triangles to the one among them that each now lies in.
  void redistribute(const std::vector<std::uint32_t>& triangles);

  EditableMesh& mesh_;
  const std::vector<PatchFrame>& frames_;
  std::vector<TriangleIndex> original_triangle_of_node_;
  std::vector<Pending> pending_;
  std::vector<std::uint32_t> first_pending_;  ///< per triangle
  std::size_t flips_left_;
  std::size_t remembered_nodes_ = 0;  ///< later nodes lie within one patch and are joined nowhere else
  std::vector<std::uint64_t> remembered_edges_;
  std::unordered_set<std::uint64_t> added_edges_;  ///< by flips, between remembered nodes
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> stack_;
  std::vector<std::uint32_t> ignored_;
  std::vector<std::uint32_t> moved_;
};

}  // namespace concave_distance::detail
