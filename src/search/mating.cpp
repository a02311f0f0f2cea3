#include "mating.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "concave_distance/base/not_computed.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"

namespace concave_distance {
namespace {

/// Where both children stand on the way from the fitter parent to the other, in [0, 1].
struct Shares {
  double first;
  double second;
};

struct Genes {
  NodeIndex first;
  NodeIndex second;
};

Genes mateOnMesh(NodeIndex fitter, NodeIndex other, const Shares& shares, MeshMetricQuery& query,
                 double path_bound) {
  if (query.metric().hasMatrices()) {
    path_bound = std::numeric_limits<double>::infinity();
  }
  const double length = query.distanceWithin(fitter, other, path_bound);
  if (!std::isfinite(length)) {
    return {fitter, other};
  }
  return {query.nodeTowards(fitter, other, shares.first * length, path_bound),
          query.nodeTowards(other, fitter, (1.0 - shares.second) * length, path_bound)};
}

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
NodeIndex nodeWithin(NodeIndex fitter, NodeIndex other, double radius, MeshMetricQuery& query,
                     double path_bound, RandomEngine& engine) {
  const double edge = static_cast<double>(query.metric().graph().edges.row(fitter.value)[0].length);
  return query.nodeTowards(fitter, other, std::min(radius, uniformUnit(engine) * (radius + edge)),
                           path_bound);
}

/// Both children within a radius of the fitter parent, `share` of the way to the other.
Genes mateNearFitter(NodeIndex fitter, NodeIndex other, double share, MeshMetricQuery& query,
                     double path_bound, RandomEngine& engine) {
  if (fitter == other) {
    return {fitter, other};
  }
  if (query.metric().hasMatrices()) {
    path_bound = std::numeric_limits<double>::infinity();
  }
  const double length = query.distanceWithin(fitter, other, path_bound);
  if (!std::isfinite(length)) {
    return {fitter, other};
  }
  const NodeIndex first = nodeWithin(fitter, other, share * length, query, path_bound, engine);
  return {first, nodeWithin(fitter, other, share * length, query, path_bound, engine)};
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

Genes mateGene(MatingMethod method, NodeIndex fitter, NodeIndex other, const Shares& shares,
               const NodeGraph& graph, MeshMetricQuery& query, double path_bound) {
  if (fitter == other) {
    return {fitter, other};
  }
  switch (method) {
    case MatingMethod::Mesh:
    case MatingMethod::MeshNearFitter:  // has a function of its own
      return mateOnMesh(fitter, other, shares, query, path_bound);
    case MatingMethod::Phenotypic:
      return mateOnLine(fitter, other, shares, graph);
    case MatingMethod::Genotypic:
      return mateIndices(fitter, other, shares);
  }
  return {fitter, other};
}

}  // namespace

double fitterShare(double fitter_squared_distance, double other_squared_distance) {
  const double sum = fitter_squared_distance + other_squared_distance;
  return sum > 0.0 ? fitter_squared_distance / sum : 0.5;
}

Children mate(MatingMethod method, const PairObjective& objective, const TrialPoint& parent_1,
              const TrialPoint& parent_2, PairMetric& metric, double path_bound, RandomEngine& engine) {
  const bool first_is_fitter = !(parent_2 < parent_1);
  const TrialPoint& fitter = first_is_fitter ? parent_1 : parent_2;
  const TrialPoint& other = first_is_fitter ? parent_2 : parent_1;
  const double share = fitterShare(fitter.squared_distance, other.squared_distance);
  if (method == MatingMethod::MeshNearFitter) {
    const Genes a = mateNearFitter(fitter.node_a, other.node_a, share, metric.onA(), path_bound, engine);
    const Genes b = mateNearFitter(fitter.node_b, other.node_b, share, metric.onB(), path_bound, engine);
    return {{a.first, b.first, kNotComputed}, {a.second, b.second, kNotComputed}};
  }
  const auto draw = [&] {
    const double first = share * uniformUnit(engine);
    return Shares{first, share + (1.0 - share) * uniformUnit(engine)};
  };
  const Genes a = mateGene(method, fitter.node_a, other.node_a, draw(), objective.gridA().graph(),
                           metric.onA(), path_bound);
  const Genes b = mateGene(method, fitter.node_b, other.node_b, draw(), objective.gridB().graph(),
                           metric.onB(), path_bound);
  return {{a.first, b.first, kNotComputed}, {a.second, b.second, kNotComputed}};
}

Children exchangeGenes(const TrialPoint& parent_1, const TrialPoint& donor_1, const TrialPoint& parent_2,
                       const TrialPoint& donor_2) {
  return {{parent_1.node_a, donor_1.node_b, kNotComputed}, {donor_2.node_a, parent_2.node_b, kNotComputed}};
}

}  // namespace concave_distance
