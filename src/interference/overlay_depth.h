#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "box_tree.h"
#include "perturbed_predicates.h"

namespace concave_distance::detail {

/// The greatest way along a direction from B's pieces up to A's: over all lines, the height of A's above B's.
/// As a function of the line it is linear on every cell of the overlay of both projections, so the greatest
/// is at one of its corners: a corner of one over a face of the other, or an edge across an edge. Both are
/// searched by branch and bound. Corners and edges count as over one another up to `lateral`, so that flush
/// walls do.
class OverlayDepth {
 public:
  struct Result {
    double depth;
    Eigen::Vector3d point_a;
    Eigen::Vector3d point_b;
  };

  /// @param start a common point of both pieces, of depth 0
  void begin(const Eigen::Vector3d& normal, const Eigen::Vector3d& start, double lateral);
  /// A plane face with boundary edges that close up, in any order; then its edges.
  void addFace(Side side, const Eigen::Vector3d& normal);
  void addEdge(Side side, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  Result solve();

 private:
  struct Edge {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
  };
  struct Face {
    Eigen::Vector3d normal;
    std::uint32_t first_edge;
    std::uint32_t last_edge;
  };
  struct Pieces {
    std::vector<Edge> edges;
    std::vector<Face> faces;
    std::vector<FlatBox> edge_boxes;
    std::vector<FlatBox> face_boxes;
    BoxTree edge_tree;
    BoxTree face_tree;
  };

  void buildTrees(Pieces& pieces);
  template <typename Visit>
  void descend(const BoxTree& tree_a, const BoxTree& tree_b, const Visit& visit);
  void offer(const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b);
  void cornerOverFace(Side corner_side, const Edge& edge, std::uint32_t face);
  void edgeAcrossEdge(const Edge& a, const Edge& b);
  void endsOverEdge(const Edge& ends, const Edge& edge, bool ends_on_a);

  Eigen::Matrix3d axes_;  ///< rows: two across, then the normal
  Eigen::Vector3d start_;
  double lateral_ = 0.0;
  double slack_ = 0.0;
  double best_ = 0.0;
  Eigen::Vector3d best_a_;
  Eigen::Vector3d best_b_;
  Pieces pieces_[2];
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_;
};

}  // namespace concave_distance::detail
