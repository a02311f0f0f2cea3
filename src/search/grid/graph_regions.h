#pragma once

#include <cstdint>
#include <vector>

#include "thin_graph.h"

namespace concave_distance::detail {

/// Which chosen node each node of a graph belongs to, and how far it is from it along the edges, metres.
class GraphRegions {
 public:
  explicit GraphRegions(const NodeGraph& graph);

  /// Chooses `seed`, which takes over what is nearer to it than to all chosen before. O(k log k) for the k
  /// nodes taken over.
  void grow(NodeIndex seed);

  const std::vector<NodeIndex>& chosen() const { return chosen_; }
  /// Infinite for what belongs to none yet.
  const std::vector<double>& distance() const { return distance_; }

  /// The graph of the chosen nodes: neighbours where regions touch. Only when every node belongs to one.
  ThinnedGraph thinned() const;

 private:
  struct Entry {
    double distance;
    std::uint32_t node;
    /// The heap functions keep the greatest in front: the nearest, and of equals the smallest node.
    friend bool operator<(const Entry& l, const Entry& r) {
      return l.distance != r.distance ? l.distance > r.distance : l.node > r.node;
    }
  };
  const NodeGraph& graph_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> owner_;
  std::vector<NodeIndex> chosen_;
  std::vector<Entry> front_;
};

}  // namespace concave_distance::detail
