#include "mesh_metric.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "thin_graph.h"

namespace concave_distance {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::size_t kLargestPredecessor = 65535;

struct HeapEntry {
  double path_length;
  std::uint32_t node;
  /// The heap functions keep the greatest in front: the nearest, and of equals the smallest node.
  friend bool operator<(const HeapEntry& l, const HeapEntry& r) {
    return l.path_length != r.path_length ? l.path_length > r.path_length : l.node > r.node;
  }
};

struct RowBuffers {
  std::vector<double> path_length;
  std::vector<HeapEntry> heap;
};

/// One row of both matrices. A predecessor changes only when the path gets strictly shorter, so that edges
/// without length close no circle.
void fillRow(const NodeGraph& graph, std::uint32_t source, RowBuffers& buffers, float* distance,
             std::uint16_t* predecessor) {
  std::vector<double>& path_length = buffers.path_length;
  std::vector<HeapEntry>& heap = buffers.heap;
  path_length.assign(graph.nodeCount(), kUnreached);
  path_length[source] = 0.0;
  predecessor[source] = static_cast<std::uint16_t>(source);
  heap.assign(1, {0.0, source});
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const HeapEntry nearest = heap.back();
    heap.pop_back();
    if (nearest.path_length > path_length[nearest.node]) {
      continue;
    }
    for (const NodeGraph::Edge& edge : graph.edges.row(nearest.node)) {
      const double through = nearest.path_length + static_cast<double>(edge.length);
      if (through < path_length[edge.to.value]) {
        path_length[edge.to.value] = through;
        predecessor[edge.to.value] = static_cast<std::uint16_t>(nearest.node);
        heap.push_back({through, edge.to.value});
        std::push_heap(heap.begin(), heap.end());
      }
    }
  }
  std::transform(path_length.begin(), path_length.end(), distance,
                 [](double length) { return static_cast<float>(length); });
}

}  // namespace

MeshMetric::MeshMetric(const NodeGraph& graph, std::size_t matrix_node_limit)
    : graph_(&graph), size_(graph.nodeCount()) {
  const std::size_t limit = std::min(matrix_node_limit, kLargestPredecessor);
  if (size_ <= limit) {
    fill(graph);
    return;
  }
  ThinnedGraph thinned = thinGraph(graph, limit);
  size_ = thinned.graph.nodeCount();
  node_ = std::move(thinned.original_node);
  owner_ = std::move(thinned.nearest);
  if (size_ <= limit) fill(thinned.graph);
}

void MeshMetric::fill(const NodeGraph& graph) {
  distance_.resize(size_ * size_);
  predecessor_.resize(size_ * size_);
  tbb::enumerable_thread_specific<RowBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size_),
                    [&](const tbb::blocked_range<std::size_t>& rows) {
                      for (std::size_t i = rows.begin(); i < rows.end(); ++i) {
                        fillRow(graph, static_cast<std::uint32_t>(i), buffers.local(), &distance_[i * size_],
                                &predecessor_[i * size_]);
                      }
                    });
}

NodeIndex MeshMetric::nodeTowards(NodeIndex from, NodeIndex to, double distance) const {
  const std::size_t target = ownerOf(to);
  std::size_t node = ownerOf(from);
  const double length = this->distance(from, to);
  if (node == target || length == kUnreached) return from;
  const auto start = node;
  // Rows of the target only: the predecessor on the way from it is the next node on the way there.
  while (node != target) {
    const std::size_t next = predecessor_[target * size_ + node];
    if (length - static_cast<double>(distance_[target * size_ + next]) > distance) break;
    node = next;
  }
  if (node == start) return from;
  return node_.empty() ? NodeIndex{node} : node_[node];
}

}  // namespace concave_distance
