#include "concave_distance/tracking/node_niches.h"

#include <limits>

namespace concave_distance {

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
