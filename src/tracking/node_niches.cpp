#include "node_niches.h"

#include <algorithm>
#include <limits>

namespace concave_distance {
namespace {

// Two bodies' neighbourhoods of this many edges around hold some forty nodes each.
constexpr int kRings = 3;

void collectRings(const NodeGraph& graph, NodeIndex centre, std::vector<NodeIndex>& nodes) {
  nodes.clear();
  nodes.push_back(centre);
  for (int ring = 0; ring < kRings; ++ring) {
    const std::size_t reached = nodes.size();
    for (std::size_t i = 0; i < reached; ++i) {
      for (const NodeGraph::Edge& edge : graph.edges.row(nodes[i].value)) {
        nodes.push_back(edge.to);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

AdmissionResult admitNodePair(const NicheCandidate& candidate, const PairGeometry& geometry,
                              double niche_radius, std::uint64_t cycle, PairMetric& metric,
                              NicheArchive& archive) {
  for (NicheRecord& record : archive.records()) {
    if (metric.distanceWithin(record.niche.node_pair, candidate.node_pair, niche_radius) <= niche_radius) {
      if (candidate.witness.squared_distance < record.niche.witness.squared_distance) {
        record.niche.node_pair = candidate.node_pair;
        placeRecord(record, geometry, candidate.witness);
      }
      return {Admission::SamePlace, record.niche.id};
    }
  }
  NicheRecord newborn;
  newborn.niche.id = archive.takeId();
  newborn.niche.birth_cycle = cycle;
  newborn.niche.node_pair = candidate.node_pair;
  newborn.niche.proven_local_minimum = candidate.proven;
  newborn.niche.outward = Outwardness::Unknown;  // this level does not look at faces
  placeRecord(newborn, geometry, candidate.witness);
  archive.records().push_back(newborn);
  return {Admission::Born, newborn.niche.id};
}

void improveNodePairs(const PairObjective& objective, std::size_t count, NicheArchive& archive,
                      PairGeometry& geometry, SearchCost& cost) {
  const NodeGraph& graph_a = objective.bodyA().graph();
  const NodeGraph& graph_b = objective.bodyB().graph();
  for (std::size_t i = 0; i < std::min(count, archive.records().size()); ++i) {
    NicheRecord& record = archive.records()[i];
    TrialPoint best = record.niche.node_pair;
    best.squared_distance = objective.squaredDistance(best.node_a, best.node_b);
    bool moved = true;
    while (moved) {
      moved = false;
      collectRings(graph_a, best.node_a, geometry.ring_a);
      collectRings(graph_b, best.node_b, geometry.ring_b);
      for (const NodeIndex node_a : geometry.ring_a) {
        for (const NodeIndex node_b : geometry.ring_b) {
          const TrialPoint candidate = objective.evaluate(node_a, node_b, cost);
          if (candidate.squared_distance < best.squared_distance) {
            best = candidate;
            moved = true;
          }
        }
      }
    }
    record.niche.node_pair = best;
    placeRecord(record, geometry, geometry.nodeWitness(best));
  }
  archive.settle();
}

void uniteWithinRadius(double niche_radius, PairMetric& metric, NicheArchive& archive,
                       std::vector<NicheEvent>& events) {
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::size_t k = i + 1;
    while (k < records.size()) {
      if (metric.distanceWithin(records[i].niche.node_pair, records[k].niche.node_pair, niche_radius) <=
          niche_radius) {
        archive.unite(i, k, events);
        archive.settle();
        k = i;
      }
      ++k;
    }
  }
}

}  // namespace concave_distance
