#include "crossed_edges.h"

#include <algorithm>
#include <cmath>

#include "base/pair_key.h"

namespace concave_distance::detail {
namespace {

/// Parameters farther apart than this are in their order in spite of rounding.
constexpr double kSureOrder = 0x1.0p-46;

std::uint64_t edgeKey(NodeIndex p, NodeIndex q) {
  return pairKey(std::min(p, q), std::max(p, q));
}

std::uint64_t edgeKey(const CrossingNode& node) {
  return edgeKey(node.low, node.high);
}

}  // namespace

void CrossedEdges::collect(WorkingFrame& frame, PerturbedPredicates& predicates, const CrossingCurves& curves,
                           Side side, const std::vector<std::uint32_t>& segments) {
  side_ = side;
  contradiction_ = kNone;
  const std::vector<CrossingNode>& nodes = curves.nodes();
  nodes_.clear();
  for (const std::uint32_t s : segments) {
    const CrossingSegment& segment = curves.segments()[s];
    for (const std::uint32_t n : {segment.start, segment.end}) {
      if (nodes[n].edge_side == side_) nodes_.push_back(n);
    }
  }
  std::sort(nodes_.begin(), nodes_.end(), [&](std::uint32_t l, std::uint32_t r) {
    const std::uint64_t key_l = edgeKey(nodes[l]);
    const std::uint64_t key_r = edgeKey(nodes[r]);
    if (key_l != key_r) return key_l < key_r;
    if (nodes[l].parameter != nodes[r].parameter) return nodes[l].parameter < nodes[r].parameter;
    return l < r;
  });
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  edges_.clear();
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const std::uint64_t key = edgeKey(nodes[nodes_[i]]);
    if (edges_.empty() || edges_.back().key != key) edges_.push_back({key, i, i});
    // Exact comparisons put right what rounding may have swapped.
    std::uint32_t j = i;
    while (j > edges_.back().first && before(frame, predicates, nodes[nodes_[j]], nodes[nodes_[j - 1]])) {
      std::swap(nodes_[j], nodes_[j - 1]);
      --j;
    }
    edges_.back().last = i + 1;
  }
  for (const Edge& edge : edges_) {
    for (std::uint32_t i = edge.first + 1; i < edge.last; ++i) {
      if (nodes[nodes_[i]].enters == nodes[nodes_[i - 1]].enters) contradiction_ = nodes_[i];
    }
  }
}

bool CrossedEdges::before(WorkingFrame& frame, PerturbedPredicates& predicates, const CrossingNode& l,
                          const CrossingNode& r) const {
  if (std::abs(l.parameter - r.parameter) > kSureOrder) return l.parameter < r.parameter;
  const auto plane = [&](const CrossingNode& node) {
    const Corners corners = frame.corners(other(side_), node.triangle);
    return PlaneOnSegment{{corners[0], corners[1], corners[2]}, node.enters ? 1 : -1};
  };
  return predicates.order(frame.point(side_, l.low), frame.point(side_, l.high), plane(l), plane(r), side_) <
         0;
}

const CrossedEdges::Edge* CrossedEdges::find(NodeIndex p, NodeIndex q) const {
  const std::uint64_t key = edgeKey(p, q);
  const auto found =
      std::lower_bound(edges_.begin(), edges_.end(), key,
                       [](const Edge& edge, std::uint64_t sought) { return edge.key < sought; });
  return found != edges_.end() && found->key == key ? &*found : nullptr;
}

}  // namespace concave_distance::detail
