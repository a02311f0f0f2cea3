#pragma once

#include <cstdint>
#include <vector>

#include "niche_admission.h"
#include "search/pair_metric.h"
#include "search/pair_objective.h"

namespace concave_distance {

/// Level `nodes`: a candidate within the niche radius (Delta, metres) of a record belongs to it, and becomes
/// its place when closer; else it is born (greedy identification, Carretero sec. 4.6.4, over time).
AdmissionResult admitNodePair(const NicheCandidate& candidate, const PairGeometry& geometry,
                              double niche_radius, std::uint64_t cycle, PairMetric& metric,
                              NicheArchive& archive);

/// Moves both nodes of a record at once, over three edges on either body, as long as that comes closer (the
/// local search over more than one node that Carretero, sec. 7.1, names): between parallel walls one gene at
/// a time ends on a staircase of shallow minima. For the nearest `count` records; the archive is settled
/// afterwards.
void improveNodePairs(const PairObjective& objective, std::size_t count, NicheArchive& archive,
                      PairGeometry& geometry, SearchCost& cost);

/// Strips records within the niche radius of a closer one, as greedy identification does; the older id lives
/// on. The archive must be settled; it is again afterwards.
void uniteWithinRadius(double niche_radius, PairMetric& metric, NicheArchive& archive,
                       std::vector<NicheEvent>& events);

}  // namespace concave_distance
