#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "triangle_pairs.h"
#include "working_frame.h"

namespace concave_distance::detail {

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// A node is a place where an edge of one body crosses a triangle of the other. If a sheet is attached to an
/// edge of a closed shell there are two: one on the curves of closed shells, one on the sheet's.
struct CrossingNode {
  Side edge_side;  ///< whose edge
  NodeIndex low;   ///< the edge's ends, low < high
  NodeIndex high;
  TriangleIndex triangle;    ///< of the other body
  bool enters;               ///< from low to high it runs into the other body
  double parameter;          ///< from 0 at low to 1 at high
  Eigen::Vector3d position;  ///< working frame
};

/// The common segment of two triangles, from node to node along normal of A x normal of B: A's surface inside
/// B lies to its left, B's inside A to its right.
struct CrossingSegment {
  TriangleIndex triangle[2];  ///< of A and of B
  std::uint32_t start;
  std::uint32_t end;
  bool closed;  ///< both triangles' shells are
};

/// Holds what two triangles in one plane have in common. Facing the same way they bound the overlap together,
/// and the motion decides whose part counts as inside. Facing each other, and pushed into each other by the
/// motion, both count: a flap that encloses nothing.
struct CommonFace {
  TriangleIndex triangle[2];
  bool opposite;
  Side inside;  ///< whose part is inside the other body; of opposite ones both are
  double area;
  Eigen::Vector3d centroid;  ///< working frame
  std::array<Eigen::Vector3d, 10> corners;
  std::size_t corner_count;
};

/// The curves where the two surfaces cross, B moved by an infinitesimal: nodes and the segments between them.
class CrossingCurves {
 public:
  /// False when the limit was reached first.
  bool find(WorkingFrame& frame, PerturbedPredicates& predicates,
            const std::vector<CandidatePair>& candidates, WorkLimit& limit);

  const std::vector<CrossingNode>& nodes() const { return nodes_; }
  const std::vector<CrossingSegment>& segments() const { return segments_; }
  const std::vector<CommonFace>& commonFaces() const { return common_faces_; }
  /// A pair of triangles had not two ends of a segment: arithmetic has over- or underflown.
  bool broken() const { return broken_; }

 private:
  /// One end of a segment before ends at the same crossing become one node.
  struct End {
    std::uint64_t edge;      ///< low and high
    std::uint64_t triangle;  ///< whose edge, and on which kind of curve
    std::uint32_t segment;
    bool is_start;
    bool enters;
  };

  void crossPair(WorkingFrame& frame, PerturbedPredicates& predicates, const CandidatePair& pair);
  void addCommonFace(const CandidatePair& pair, const Corners& a, const Corners& b, bool b_below);
  void appendEnd(Side side, NodeIndex from, NodeIndex to, TriangleIndex triangle, bool enters, bool closed);
  void joinEnds(WorkingFrame& frame);

  std::vector<CrossingNode> nodes_;
  std::vector<CrossingSegment> segments_;
  std::vector<CommonFace> common_faces_;
  std::vector<End> ends_;
  bool broken_ = false;
};

}  // namespace concave_distance::detail
