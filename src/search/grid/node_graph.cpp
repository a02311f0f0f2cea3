#include "node_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance {
namespace {

CompressedRows<NodeGraph::Edge> collectEdges(std::size_t node_count,
                                             const std::vector<std::pair<NodeIndex, NodeIndex>>& neighbours) {
  // Every edge in both directions, packed so that one sort groups by source and orders by target.
  std::vector<std::uint64_t> directed;
  directed.reserve(2 * neighbours.size());
  for (const auto& [from, to] : neighbours) {
    if (from != to) {  // a degenerate triangle names a node twice
      directed.push_back((std::uint64_t{from.value} << 32U) | to.value);
      directed.push_back((std::uint64_t{to.value} << 32U) | from.value);
    }
  }
  std::sort(directed.begin(), directed.end());
  directed.erase(std::unique(directed.begin(), directed.end()), directed.end());

  CompressedRows<NodeGraph::Edge> rows;
  rows.offsets.assign(node_count + 1, 0);
  rows.values.reserve(directed.size());
  for (const std::uint64_t pair : directed) {
    ++rows.offsets[(pair >> 32U) + 1];
    rows.values.push_back({NodeIndex{static_cast<std::uint32_t>(pair & 0xffffffffU)}, 0.0F});
  }
  for (std::size_t i = 1; i < rows.offsets.size(); ++i) {
    rows.offsets[i] += rows.offsets[i - 1];
  }
  return rows;
}

/// A float not below `length` that is a multiple of `quantum`, a power of two.
float roundUp(double length, double quantum) {
  const double multiple = std::ceil(length / quantum) * quantum;  // exact but for the rounding up
  auto rounded = static_cast<float>(multiple);
  if (rounded < multiple) {
    rounded = std::nextafter(rounded, std::numeric_limits<float>::infinity());
  }
  return rounded;
}

/// Why the sums are exact: a simple path is at most as long as all edges together, below 2^52 quanta, and
/// every partial sum is a whole number of quanta. A float is a whole number of its own last places; those
/// that are finer than a quantum were rounded away, coarser ones are multiples of it.
void setLengths(NodeGraph& graph) {
  double total = 0.0;
  for (std::size_t i = 0; i < graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : graph.edges.row(i)) {
      total += (graph.positions[edge.to.value] - graph.positions[i]).norm();
    }
  }
  // `total` counts every edge twice, which leaves room for what rounding up adds.
  int exponent = 0;
  std::frexp(total, &exponent);
  graph.length_quantum = std::ldexp(1.0, exponent - 52);
  for (std::size_t i = 0; i < graph.nodeCount(); ++i) {
    for (std::size_t k = graph.edges.offsets[i]; k < graph.edges.offsets[i + 1]; ++k) {
      NodeGraph::Edge& edge = graph.edges.values[k];
      // From the smaller to the larger node, so that both directions are the same number.
      const std::size_t low = std::min<std::size_t>(i, edge.to.value);
      const std::size_t high = std::max<std::size_t>(i, edge.to.value);
      edge.length = roundUp((graph.positions[high] - graph.positions[low]).norm(), graph.length_quantum);
    }
  }
}

void setShells(NodeGraph& graph) {
  constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
  graph.shell.assign(graph.nodeCount(), kUnseen);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < graph.nodeCount(); ++first) {
    if (graph.shell[first] != kUnseen) {
      continue;
    }
    graph.shell[first] = graph.shell_count;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const NodeGraph::Edge& edge : graph.edges.row(node)) {
        if (graph.shell[edge.to.value] == kUnseen) {
          graph.shell[edge.to.value] = graph.shell_count;
          open.push_back(edge.to.value);
        }
      }
    }
    ++graph.shell_count;
  }
}

void setNeighbourhoods(NodeGraph& graph, const Eigen::Vector3d& origin) {
  using Neighbourhood = NodeGraph::Neighbourhood;
  Neighbourhood empty{};
  empty.x.fill(Neighbourhood::kFarAway);
  empty.y.fill(Neighbourhood::kFarAway);
  empty.z.fill(Neighbourhood::kFarAway);
  empty.more = Neighbourhood::kNoMore;
  graph.neighbourhood_origin = origin;
  graph.neighbourhoods.assign(graph.nodeCount(), empty);
  for (std::size_t node = 0; node < graph.nodeCount(); ++node) {
    const auto row = graph.edges.row(node);
    std::size_t current = node;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t seat = i % Neighbourhood::kSize;
      if (i > 0 && seat == 0) {
        graph.neighbourhoods[current].more = static_cast<std::uint32_t>(graph.neighbourhoods.size());
        current = graph.neighbourhoods.size();
        graph.neighbourhoods.push_back(empty);
      }
      const Eigen::Vector3f position = (graph.positions[row[i].to.value] - origin).cast<float>();
      Neighbourhood& part = graph.neighbourhoods[current];
      part.x[seat] = position.x();
      part.y[seat] = position.y();
      part.z[seat] = position.z();
      part.to[seat] = row[i].to.value;
      ++part.count;
    }
  }
}

}  // namespace

NodeGraph buildNodeGraph(const SurfaceMesh& grid) {
  std::vector<std::pair<NodeIndex, NodeIndex>> neighbours;
  neighbours.reserve(3 * grid.triangleCount());
  for (const TriangleNodes& t : grid.triangles()) {
    neighbours.emplace_back(t[0], t[1]);
    neighbours.emplace_back(t[1], t[2]);
    neighbours.emplace_back(t[2], t[0]);
  }
  return buildNodeGraph(grid.vertices(), neighbours);
}

NodeGraph buildNodeGraph(std::vector<Eigen::Vector3d> positions,
                         const std::vector<std::pair<NodeIndex, NodeIndex>>& neighbours) {
  NodeGraph graph;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions) {
    box.extend(position);
  }
  graph.positions = std::move(positions);
  graph.edges = collectEdges(graph.nodeCount(), neighbours);
  setLengths(graph);
  setShells(graph);
  setNeighbourhoods(graph, box.center());
  return graph;
}

}  // namespace concave_distance
