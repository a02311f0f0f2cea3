#include "node_niches.h"

#include <algorithm>
#include <limits>

#include "distance/niches/niche_properties.h"

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

void followNodePairs(const PairFrame& frame, NicheSearch& search, double displacement, double elapsed,
                     NicheArchive& archive, SearchCost& cost, WorkLimit& limit) {
  const double rounding = kPlateauTolerance * frame.diameters();
  for (NicheRecord& record : archive.records()) {
    if (limit.isOver()) {
      carryRecord(record, frame);
      TrialPoint& pair = record.niche.node_pair;
      pair.squared_distance = nodeWitness(frame, pair).squared_distance;
      continue;
    }
    const double before = record.niche.distance;
    // A minimum that was not descended may be far below its points.
    record.least_distance =
        record.carried ? -std::numeric_limits<double>::infinity() : before - displacement - rounding;
    record.carried = false;
    record.niche.node_pair = search.descendKnown(frame, record.niche.node_pair, cost);
    record.niche.origin = NicheOrigin::Inherited;
    placeRecord(record, frame, nodeWitness(frame, record.niche.node_pair));
    record.niche.closing_speed = elapsed > 0.0 ? (before - record.niche.distance) / elapsed : kNotComputed;
  }
}

namespace {

void admitNodePair(const TrialPoint& pair, const PairFrame& frame, double niche_radius, std::uint64_t cycle,
                   PairMetric& metric, NicheArchive& archive) {
  const WitnessPair witness = nodeWitness(frame, pair);
  for (NicheRecord& record : archive.records()) {
    if (metric.distance(record.niche.node_pair, pair) > niche_radius) continue;
    if (witness.squared_distance < record.niche.witness.squared_distance) {
      record.niche.node_pair = pair;
      placeRecord(record, frame, witness);
    }
    return;
  }
  NicheRecord newborn;
  newborn.niche.id = archive.takeId();
  newborn.niche.birth_cycle = cycle;
  newborn.niche.node_pair = pair;
  newborn.niche.origin = NicheOrigin::Evolved;
  newborn.niche.outward = Outwardness::Unknown;  // this level does not look at faces
  placeRecord(newborn, frame, witness);
  archive.records().push_back(newborn);
}

}  // namespace

void admitNodePairs(const PairFrame& frame, const TrackerParameters& parameters, NicheSearch& search,
                    const std::vector<TrialPoint>& found, bool warm, std::uint64_t cycle,
                    NicheArchive& archive, PairSolution& solution) {
  const double niche_radius = search.radii(warm).niche;
  PairMetric& metric = search.workspace().metric;
  // Niches that have run on into another basin are forgotten and found anew.
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = records.size(); i-- > 0;) {
    if (records[i].niche.distance >= records[i].least_distance) continue;
    const TrialPoint pair = records[i].niche.node_pair;
    archive.remove(i, solution.events);
    admitNodePair(pair, frame, niche_radius, cycle, metric, archive);
  }
  for (const TrialPoint& pair : found) {
    admitNodePair(pair, frame, niche_radius, cycle, metric, archive);
  }
  archive.settle();
  uniteWithinRadius(niche_radius, metric, archive, solution.events);
  improveNodePairs(PairObjective(frame.a, frame.b, frame.a_from_b), parameters.largest_niche_count, archive,
                   frame, search.rings(), solution.cost);
}

void improveNodePairs(const PairObjective& objective, std::size_t count, NicheArchive& archive,
                      const PairFrame& frame, NodeRings& rings, SearchCost& cost) {
  const NodeGraph& graph_a = objective.gridA().graph();
  const NodeGraph& graph_b = objective.gridB().graph();
  for (std::size_t i = 0; i < std::min(count, archive.records().size()); ++i) {
    NicheRecord& record = archive.records()[i];
    TrialPoint best = record.niche.node_pair;
    best.squared_distance = objective.squaredDistance(best.node_a, best.node_b);
    bool moved = true;
    while (moved) {
      moved = false;
      collectRings(graph_a, best.node_a, rings.a);
      collectRings(graph_b, best.node_b, rings.b);
      for (const NodeIndex node_a : rings.a) {
        for (const NodeIndex node_b : rings.b) {
          const TrialPoint candidate = objective.evaluate(node_a, node_b, cost);
          if (candidate.squared_distance < best.squared_distance) {
            best = candidate;
            moved = true;
          }
        }
      }
    }
    record.niche.node_pair = best;
    placeRecord(record, frame, nodeWitness(frame, best));
  }
  archive.settle();
}

void uniteWithinRadius(double niche_radius, PairMetric& metric, NicheArchive& archive,
                       std::vector<NicheEvent>& events) {
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::size_t k = i + 1;
    while (k < records.size()) {
      if (metric.distance(records[i].niche.node_pair, records[k].niche.node_pair) <= niche_radius) {
        archive.unite(i, k, events);
        archive.settle();
        k = i;
      }
      ++k;
    }
  }
}

}  // namespace concave_distance
