#include "mutation.h"

#include <algorithm>

#include "concave_distance/base/not_computed.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"

namespace concave_distance {

NodeIndex randomNode(const NodeGraph& graph, RandomEngine& engine) {
  return NodeIndex{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
}

NodeIndex moveGene(NodeIndex node, double radius, const MeshMetric& metric, RandomEngine& engine) {
  const NodeGraph& graph = metric.graph();
  const NodeIndex goal = randomNode(graph, engine);
  const double share = uniformUnit(engine);
  if (graph.shell[goal.value] != graph.shell[node.value]) {
    return goal;
  }
  if (node == goal) {
    return node;
  }
  // An edge longer than the path, so that its last node has its share of the draws too; 1 - share is never 0.
  const double length =
      metric.distance(node, goal) + static_cast<double>(graph.edges.row(goal.value)[0].length);
  return metric.nodeTowards(node, goal, (1.0 - share) * std::min(length, radius));
}

TrialPoint mutate(const TrialPoint& point, PairMetric& metric, RandomEngine& engine, double radius) {
  TrialPoint moved = point;
  moved.squared_distance = kNotComputed;
  const std::uint32_t genes = uniformIndex(engine, 3);
  if (genes != 1) {
    moved.node_a = moveGene(point.node_a, radius, metric.onA(), engine);
  }
  if (genes != 0) {
    moved.node_b = moveGene(point.node_b, radius, metric.onB(), engine);
  }
  return moved;
}

TrialPoint randomTrialPoint(const PairObjective& objective, RandomEngine& engine) {
  const NodeIndex node_a = randomNode(objective.gridA().graph(), engine);
  return {node_a, randomNode(objective.gridB().graph(), engine), kNotComputed};
}

}  // namespace concave_distance
