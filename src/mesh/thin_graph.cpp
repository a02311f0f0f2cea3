#include "concave_distance/mesh/thin_graph.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace concave_distance {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Which chosen node each node belongs to, and how far it is from it along the edges.
struct Regions {
  const NodeGraph& graph;
  std::vector<double> distance;
  std::vector<std::uint32_t> owner;
  std::vector<NodeIndex> chosen;

  explicit Regions(const NodeGraph& g)
      : graph(g), distance(g.nodeCount(), kInfinity), owner(g.nodeCount(), 0) {}

  // Takes over what is nearer to `seed` than to all chosen before.
  void grow(NodeIndex seed) {
    using Entry = std::tuple<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    const auto region = static_cast<std::uint32_t>(chosen.size());
    chosen.push_back(seed);
    distance[seed.value] = 0.0;
    owner[seed.value] = region;
    front.emplace(0.0, seed.value);
    while (!front.empty()) {
      const auto [reached, node] = front.top();
      front.pop();
      if (reached > distance[node]) {
        continue;
      }
      for (const NodeGraph::Edge& edge : graph.edges.row(node)) {
        const double next = reached + static_cast<double>(edge.length);
        if (next < distance[edge.to.value]) {
          distance[edge.to.value] = next;
          owner[edge.to.value] = region;
          front.emplace(next, edge.to.value);
        }
      }
    }
  }
};

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
  Regions regions(graph);
  std::uint32_t next_shell = 0;
  for (std::uint32_t node = 0; node < graph.nodeCount(); ++node) {
    if (graph.shell[node] == next_shell) {  // shells are numbered by their first node
      regions.grow(NodeIndex{node});
      ++next_shell;
    }
  }
  FarthestFirst farthest_first(regions.distance);
  while (regions.chosen.size() < std::min(node_count, graph.nodeCount())) {
    const NodeIndex farthest = farthest_first.top();
    if (regions.distance[farthest.value] == 0.0) {
      break;  // what is left coincides with chosen nodes
    }
    regions.grow(farthest);
  }

  ThinnedGraph thinned;
  std::vector<Eigen::Vector3d> positions;
  for (const NodeIndex node : regions.chosen) {
    positions.push_back(graph.positions[node.value]);
  }
  std::vector<std::pair<NodeIndex, NodeIndex>> neighbours;
  for (std::uint32_t node = 0; node < graph.nodeCount(); ++node) {
    for (const NodeGraph::Edge& edge : graph.edges.row(node)) {
      const NodeIndex here{regions.owner[node]};
      const NodeIndex there{regions.owner[edge.to.value]};
      if (here < there) {
        neighbours.emplace_back(here, there);
        thinned.longest_edge =
            std::max(thinned.longest_edge, (positions[here.value] - positions[there.value]).norm());
      }
    }
  }
  for (const std::uint32_t owner : regions.owner) {
    thinned.nearest.emplace_back(owner);
  }
  thinned.original_node = std::move(regions.chosen);
  thinned.graph = buildNodeGraph(std::move(positions), neighbours);
  return thinned;
}

}  // namespace concave_distance
