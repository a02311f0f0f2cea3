#include "mating_methods.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"

namespace concave_distance {
namespace {

NodeIndex nearestNode(const NodeGraph& graph, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < graph.positions.size(); ++i) {
    const double candidate = squaredDistanceBetween(graph.positions[i], point);
    if (candidate < least) {
      least = candidate;
      nearest = i;
    }
  }
  return NodeIndex{nearest};
}

/// One node of the path within `radius` of the fitter parent, its last one with as much of the draws as the
/// others: hence an edge more than the radius.
NodeIndex nodeWithin(NodeIndex fitter, NodeIndex other, double radius, const MeshMetric& metric,
                     RandomEngine& engine) {
  const double edge = static_cast<double>(metric.graph().edges.row(fitter.value)[0].length);
  return metric.nodeTowards(fitter, other, std::min(radius, uniformUnit(engine) * (radius + edge)));
}

/// Both children within a radius of the fitter parent, `share` of the way to the other.
Genes mateNearFitter(NodeIndex fitter, NodeIndex other, double share, const MeshMetric& metric,
                     RandomEngine& engine) {
  if (fitter == other) {
    return {fitter, other};
  }
  const double length = metric.distance(fitter, other);
  if (!std::isfinite(length)) {
    return {fitter, other};
  }
  const NodeIndex first = nodeWithin(fitter, other, share * length, metric, engine);
  return {first, nodeWithin(fitter, other, share * length, metric, engine)};
}

Genes mateOnLine(NodeIndex fitter, NodeIndex other, const Shares& shares, const NodeGraph& graph) {
  const Eigen::Vector3d& from = graph.positions[fitter.value];
  const Eigen::Vector3d displacement = graph.positions[other.value] - from;
  return {nearestNode(graph, from + shares.first * displacement),
          nearestNode(graph, from + shares.second * displacement)};
}

Genes mateIndices(NodeIndex fitter, NodeIndex other, const Shares& shares) {
  const double from = fitter.value;
  const double displacement = static_cast<double>(other.value) - from;
  return {NodeIndex{static_cast<std::uint32_t>(std::lround(from + shares.first * displacement))},
          NodeIndex{static_cast<std::uint32_t>(std::lround(from + shares.second * displacement))}};
}

}  // namespace

Children mateBy(MatingMethod method, const PairObjective& objective, const TrialPoint& parent_1,
                const TrialPoint& parent_2, PairMetric& metric, RandomEngine& engine) {
  if (method == MatingMethod::Mesh) return mate(parent_1, parent_2, metric, engine);
  const Couple couple(parent_1, parent_2);
  const auto [fitter, other, share] = couple;
  if (method == MatingMethod::MeshNearFitter) {
    const Genes a = mateNearFitter(fitter.node_a, other.node_a, share, metric.onA(), engine);
    const Genes b = mateNearFitter(fitter.node_b, other.node_b, share, metric.onB(), engine);
    return childrenOf(a, b);
  }
  const auto gene = [&](NodeIndex from, NodeIndex to, const NodeGraph& graph) {
    const Shares shares = couple.drawShares(engine);
    if (from == to) return Genes{from, to};
    return method == MatingMethod::Phenotypic ? mateOnLine(from, to, shares, graph)
                                              : mateIndices(from, to, shares);
  };
  const Genes a = gene(fitter.node_a, other.node_a, objective.gridA().graph());
  const Genes b = gene(fitter.node_b, other.node_b, objective.gridB().graph());
  return childrenOf(a, b);
}

}  // namespace concave_distance
