#include "mesh_metric.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

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
    : graph_(&graph),
      node_count_(graph.nodeCount()),
      has_matrices_(wantsMatrices(node_count_, matrix_node_limit)) {
  if (!has_matrices_) {
    return;
  }
  distance_.resize(node_count_ * node_count_);
  predecessor_.resize(node_count_ * node_count_);
  tbb::enumerable_thread_specific<RowBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, node_count_),
                    [&](const tbb::blocked_range<std::size_t>& rows) {
                      for (std::size_t i = rows.begin(); i < rows.end(); ++i) {
                        fillRow(graph, static_cast<std::uint32_t>(i), buffers.local(),
                                &distance_[i * node_count_], &predecessor_[i * node_count_]);
                      }
                    });
}

bool MeshMetric::wantsMatrices(std::size_t node_count, std::size_t matrix_node_limit) {
  return node_count <= std::min(matrix_node_limit, kLargestPredecessor);
}

}  // namespace concave_distance
