#include "graph_regions.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace concave_distance::detail {

GraphRegions::GraphRegions(const NodeGraph& graph)
    : graph_(graph),
      distance_(graph.nodeCount(), std::numeric_limits<double>::infinity()),
      owner_(graph.nodeCount(), 0) {}

void GraphRegions::grow(NodeIndex seed) {
  const auto region = static_cast<std::uint32_t>(chosen_.size());
  chosen_.push_back(seed);
  distance_[seed.value] = 0.0;
  owner_[seed.value] = region;
  front_.assign(1, {0.0, seed.value});
  while (!front_.empty()) {
    std::pop_heap(front_.begin(), front_.end());
    const Entry nearest = front_.back();
    front_.pop_back();
    if (nearest.distance > distance_[nearest.node]) {
      continue;
    }
    for (const NodeGraph::Edge& edge : graph_.edges.row(nearest.node)) {
      const double next = nearest.distance + static_cast<double>(edge.length);
      if (next < distance_[edge.to.value]) {
        distance_[edge.to.value] = next;
        owner_[edge.to.value] = region;
        front_.push_back({next, edge.to.value});
        std::push_heap(front_.begin(), front_.end());
      }
    }
  }
}

ThinnedGraph GraphRegions::thinned() const {
  ThinnedGraph thinned;
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(chosen_.size());
  for (const NodeIndex node : chosen_) {
    positions.push_back(graph_.positions[node.value]);
  }
  std::vector<std::pair<NodeIndex, NodeIndex>> neighbours;
  for (std::uint32_t node = 0; node < graph_.nodeCount(); ++node) {
    for (const NodeGraph::Edge& edge : graph_.edges.row(node)) {
      const NodeIndex here{owner_[node]};
      const NodeIndex there{owner_[edge.to.value]};
      if (here < there) {
        neighbours.emplace_back(here, there);
        thinned.longest_edge =
            std::max(thinned.longest_edge, (positions[here.value] - positions[there.value]).norm());
      }
    }
  }
  thinned.nearest.reserve(owner_.size());
  for (const std::uint32_t owner : owner_) {
    thinned.nearest.emplace_back(owner);
  }
  thinned.original_node = chosen_;
  thinned.graph = buildNodeGraph(std::move(positions), neighbours);
  return thinned;
}

}  // namespace concave_distance::detail
