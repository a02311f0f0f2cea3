#include "thin_graph.h"

#include <algorithm>

#include "graph_regions.h"

namespace concave_distance {
namespace {

// Nodes by their distance, the farthest first, of equals the smallest. Distances only fall, so an entry that
// is out of date stands too early: it is put back when it comes up, and never are all nodes looked through.
class FarthestFirst {
 public:
  explicit FarthestFirst(const std::vector<double>& distance) : distance_(distance) {
    entries_.reserve(distance.size());
    for (std::uint32_t node = 0; node < distance.size(); ++node) {
      entries_.push_back({distance[node], node});
    }
    std::make_heap(entries_.begin(), entries_.end());
  }

  NodeIndex top() {
    while (entries_.front().distance != distance_[entries_.front().node]) {
      std::pop_heap(entries_.begin(), entries_.end());
      entries_.back().distance = distance_[entries_.back().node];
      std::push_heap(entries_.begin(), entries_.end());
    }
    return NodeIndex{entries_.front().node};
  }

 private:
  struct Entry {
    double distance;
    std::uint32_t node;
    friend bool operator<(const Entry& l, const Entry& r) {
      return l.distance != r.distance ? l.distance < r.distance : l.node > r.node;
    }
  };
  const std::vector<double>& distance_;
  std::vector<Entry> entries_;
};

}  // namespace

ThinnedGraph thinGraph(const NodeGraph& graph, std::size_t node_count) {
  detail::GraphRegions regions(graph);
  std::uint32_t next_shell = 0;
  for (std::uint32_t node = 0; node < graph.nodeCount(); ++node) {
    if (graph.shell[node] == next_shell) {  // shells are numbered by their first node
      regions.grow(NodeIndex{node});
      ++next_shell;
    }
  }
  FarthestFirst farthest_first(regions.distance());
  while (regions.chosen().size() < std::min(node_count, graph.nodeCount())) {
    const NodeIndex farthest = farthest_first.top();
    if (regions.distance()[farthest.value] == 0.0) {
      break;  // what is left coincides with chosen nodes
    }
    regions.grow(farthest);
  }
  return regions.thinned();
}

}  // namespace concave_distance
