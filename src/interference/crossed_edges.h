#pragma once

#include <cstdint>
#include <vector>

#include "crossings.h"

namespace concave_distance::detail {

/// Holds the edges of one body that the crossing curves cross, with the nodes on each in
/// order. Keeps buffers.
class CrossedEdges {
 public:
  /// The nodes of an edge are node(first) to node(last - 1), in order from its lower end.
  struct Edge {
    std::uint64_t key;
    std::uint32_t first;
    std::uint32_t last;
  };

  /// @param segments of the curves whose nodes count
  void collect(WorkingFrame& frame, PerturbedPredicates& predicates, const CrossingCurves& curves, Side side,
               const std::vector<std::uint32_t>& segments);

  const std::vector<Edge>& edges() const { return edges_; }
  std::uint32_t node(std::uint32_t i) const { return nodes_[i]; }
  /// Returns nullptr for an edge that is not crossed.
  const Edge* find(NodeIndex p, NodeIndex q) const;
  /// Returns a node of an edge along which the surface enters twice in turn; kNone: none.
  std::uint32_t contradiction() const { return contradiction_; }

 private:
  bool before(WorkingFrame& frame, PerturbedPredicates& predicates, const CrossingNode& l,
              const CrossingNode& r) const;

  Side side_ = Side::A;
  std::vector<std::uint32_t> nodes_;
  std::vector<Edge> edges_;
  std::uint32_t contradiction_ = kNone;
};

}  // namespace concave_distance::detail
