#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/union_find.h"
#include "containment.h"
#include "crossed_edges.h"
#include "crossings.h"

namespace concave_distance::detail {

/// A piece of the boundary of what is inside of one crossed triangle; the inside lies to its left.
struct PieceEdge {
  TriangleIndex triangle;
  std::uint32_t element;
  Eigen::Vector3d from;  ///< working frame
  Eigen::Vector3d to;
};

struct WholeTriangle {
  TriangleIndex triangle;
  std::uint32_t element;
};

/// Holds what the crossing curves cut out of one body's surface: the part inside the other body, as boundary
/// edges in crossed triangles and as whole ones. It knows closed shells crossed by closed shells only.
class SurfacePieces {
 public:
  /// Adds the inside vertices to `sets`, which hold the nodes, and unites what hangs together.
  void collect(WorkingFrame& frame, PerturbedPredicates& predicates, Containment& containment,
               const CrossingCurves& curves, Side side, UnionFind& sets);
  /// Counts a whole shell without crossings as inside; closed ones before open ones.
  void addShell(WorkingFrame& frame, TriangleIndex triangle, UnionFind& sets);

  const std::vector<PieceEdge>& edges() const { return edges_; }
  const std::vector<WholeTriangle>& wholes() const { return wholes_; }
  std::vector<PieceEdge>& edges() { return edges_; }
  std::vector<WholeTriangle>& wholes() { return wholes_; }
  /// A node of an edge along which the surface enters twice in turn; kNone: none.
  std::uint32_t contradiction() const { return crossed_edges_.contradiction(); }

 private:
  struct Mark {
    std::uint32_t stamp = 0;
    std::uint32_t value = 0;
  };
  enum TriangleState : std::uint32_t { kCrossed, kWhole };

  void startStamp(const WorkingFrame& frame);
  std::uint32_t markInside(NodeIndex vertex, UnionFind& sets);
  bool isInside(NodeIndex vertex) const { return vertex_marks_[vertex.value].stamp == stamp_; }
  void seedFromEdges(const CrossingCurves& curves, UnionFind& sets);
  void seedFromLoops(WorkingFrame& frame, PerturbedPredicates& predicates, Containment& containment,
                     const CrossingCurves& curves, UnionFind& sets);
  /// Spreads over closed shells, or over one open shell.
  void spread(const WorkingFrame& frame, UnionFind& sets, std::uint32_t open_shell = kNone);
  void emitTriangle(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first, std::size_t last,
                    UnionFind& sets);
  void emitEdge(WorkingFrame& frame, const CrossingCurves& curves, TriangleIndex triangle, NodeIndex from,
                NodeIndex to, UnionFind& sets);
  void uniteHoles(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first, std::size_t last,
                  std::size_t first_edge, UnionFind& sets);

  Side side_ = Side::A;
  std::uint32_t stamp_ = 0;
  std::vector<Mark> vertex_marks_;    ///< value: element
  std::vector<Mark> triangle_marks_;  ///< value: TriangleState
  CrossedEdges crossed_edges_;
  std::vector<std::uint32_t> segments_;  ///< by triangle
  std::vector<std::uint32_t> segment_after_node_;
  std::vector<std::uint8_t> seen_;
  std::vector<NodeIndex> waiting_;
  std::vector<PieceEdge> edges_;
  std::vector<WholeTriangle> wholes_;
};

}  // namespace concave_distance::detail
