#include "geodesic_extent.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "base/union_find.h"

namespace concave_distance {

std::vector<double> pathLengthsFrom(const NodeGraph& graph, const std::vector<NodeIndex>& sources) {
  using Open = std::pair<double, std::uint32_t>;
  std::vector<double> path_length(graph.nodeCount(), std::numeric_limits<double>::infinity());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (const NodeIndex source : sources) {
    path_length[source.value] = 0.0;
    open.emplace(0.0, source.value);
  }
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > path_length[node]) {
      continue;
    }
    for (const NodeGraph::Edge& edge : graph.edges.row(node)) {
      const double through = length + static_cast<double>(edge.length);
      if (through < path_length[edge.to.value]) {
        path_length[edge.to.value] = through;
        open.emplace(through, edge.to.value);
      }
    }
  }
  return path_length;
}

double geodesicExtent(const NodeGraph& graph) {
  std::vector<NodeIndex> ends(graph.shell_count);
  for (std::size_t node = graph.nodeCount(); node-- > 0;) {
    ends[graph.shell[node]] = NodeIndex{node};
  }
  std::vector<double> farthest(graph.shell_count);
  for (int sweep = 0; sweep < 2; ++sweep) {
    const std::vector<double> path_length = pathLengthsFrom(graph, ends);
    std::fill(farthest.begin(), farthest.end(), -1.0);
    for (std::size_t node = 0; node < graph.nodeCount(); ++node) {
      double& so_far = farthest[graph.shell[node]];
      if (path_length[node] > so_far) {
        so_far = path_length[node];
        ends[graph.shell[node]] = NodeIndex{node};
      }
    }
  }
  double weighted = 0.0;
  for (const std::uint32_t shell : graph.shell) {
    weighted += farthest[shell];
  }
  return weighted / static_cast<double>(graph.nodeCount());
}

namespace {

/// Distance of every node from the centroid of all, metres.
std::vector<double> heightsOf(const NodeGraph& graph) {
  const std::size_t nodes = graph.nodeCount();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& position : graph.positions) {
    centroid += position / static_cast<double>(nodes);
  }
  std::vector<double> height(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    height[node] = (graph.positions[node] - centroid).norm();
  }
  return height;
}

}  // namespace

std::vector<Protrusion> findProtrusions(const NodeGraph& graph, double least_prominence) {
  const std::size_t nodes = graph.nodeCount();
  const std::vector<double> height = heightsOf(graph);
  std::vector<std::uint32_t> from_top(nodes);
  std::iota(from_top.begin(), from_top.end(), 0U);
  std::sort(from_top.begin(), from_top.end(), [&](std::uint32_t l, std::uint32_t r) {
    return height[l] != height[r] ? height[l] > height[r] : l < r;
  });
  std::vector<std::uint32_t> rank(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) {
    rank[from_top[i]] = i;
  }

  // The flood sinks; an island is known by the rank of its top, which is its lowest member. Where two
  // islands meet, the lower top has its saddle.
  const double least = least_prominence * height[from_top[0]];
  std::vector<Protrusion> found;
  const auto note = [&](std::uint32_t top, double prominence) {
    if (prominence >= least) {
      found.push_back({NodeIndex{from_top[top]}, height[from_top[top]], prominence});
    }
  };
  UnionFind islands(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) {
    for (const NodeGraph::Edge& edge : graph.edges.row(from_top[i])) {
      if (rank[edge.to.value] > i) {
        continue;  // still under water
      }
      const std::uint32_t here = islands.find(i);
      const std::uint32_t there = islands.find(rank[edge.to.value]);
      const std::uint32_t lower_top = std::max(here, there);
      if (here != there && lower_top != i) {
        note(lower_top, height[from_top[lower_top]] - height[from_top[i]]);
      }
      islands.unite(here, there);
    }
  }
  for (std::uint32_t i = 0; i < nodes; ++i) {
    if (islands.find(i) == i) {
      note(i, height[from_top[i]]);
    }
  }
  std::sort(found.begin(), found.end(), [](const Protrusion& l, const Protrusion& r) {
    return l.prominence != r.prominence ? l.prominence > r.prominence : l.node < r.node;
  });
  return found;
}

double protrusionSpacing(const MeshMetric& metric, double bound) {
  constexpr double kLeastProminence = 0.05;
  constexpr std::size_t kProtrusionLimit = 64;  // the most prominent are enough; the others only cost time
  std::vector<Protrusion> protrusions = findProtrusions(metric.graph(), kLeastProminence);
  protrusions.resize(std::min(protrusions.size(), kProtrusionLimit));
  double spacing = bound;
  for (std::size_t i = 0; i < protrusions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      spacing = std::min(spacing, metric.distance(protrusions[i].node, protrusions[j].node));
    }
  }
  return spacing;
}

}  // namespace concave_distance
