#include "niche_motion.h"

#include <algorithm>

#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"

namespace concave_distance::evaluation {
namespace {

/// Where a node is expected next that was at `nodes`, the last one first.
Eigen::Vector3d expectedPoint(const NodeGraph& graph, const std::array<NodeIndex, 3>& nodes,
                              std::size_t count) {
  const Eigen::Vector3d& last = graph.positions[nodes[0].value];
  if (count < 2) return last;
  const Eigen::Vector3d& before = graph.positions[nodes[1].value];
  if (count < 3) return last + (last - before);
  return last + (last - before) + (last - 2.0 * before + graph.positions[nodes[2].value]);
}

}  // namespace

NodeIndex nodeTowardsPoint(const NodeGraph& graph, NodeIndex start, const Eigen::Vector3d& goal) {
  const auto distance = [&](NodeIndex node) { return (graph.positions[node.value] - goal).squaredNorm(); };
  NodeIndex node = start;
  double least = distance(node);
  for (bool has_moved = true; has_moved;) {
    has_moved = false;
    for (const NodeGraph::Edge& edge : graph.edges.row(node.value)) {
      const double candidate = distance(edge.to);
      if (candidate < least) {
        least = candidate;
        node = edge.to;
        has_moved = true;
      }
    }
  }
  return node;
}

NicheMotion::Path NicheMotion::pathTo(const TrialPoint& niche, double radius, PairMetric& metric) const {
  const Path* nearest = nullptr;
  double least = radius;
  for (const Path& path : paths_) {
    const double distance = metric.distance(path.places[0], niche);
    if (distance <= least) {
      least = distance;
      nearest = &path;
    }
  }
  Path path;
  path.places[0] = niche;
  if (nearest != nullptr) {
    path.places[1] = nearest->places[0];
    path.places[2] = nearest->places[1];
    path.count = std::min<std::size_t>(nearest->count + 1, path.places.size());
  }
  return path;
}

void NicheMotion::extrapolate(double radius, PairMetric& metric, std::vector<TrialPoint>& niches) {
  if (extrapolation_ == Extrapolation::None) return;
  const std::size_t most = extrapolation_ == Extrapolation::Velocity ? 2 : 3;
  next_.clear();
  for (TrialPoint& niche : niches) {
    const Path path = pathTo(niche, radius, metric);
    next_.push_back(path);
    const std::size_t count = std::min(path.count, most);
    const auto& [last, before, first] = path.places;
    niche.node_a = nodeTowardsPoint(
        gridOf(*a_).graph(), last.node_a,
        expectedPoint(gridOf(*a_).graph(), {last.node_a, before.node_a, first.node_a}, count));
    niche.node_b = nodeTowardsPoint(
        gridOf(*b_).graph(), last.node_b,
        expectedPoint(gridOf(*b_).graph(), {last.node_b, before.node_b, first.node_b}, count));
  }
  paths_.swap(next_);
}

}  // namespace concave_distance::evaluation
