#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "niche_archive.h"
#include "niche_placement.h"
#include "niche_search.h"
#include "search/pair_metric.h"
#include "search/pair_objective.h"

namespace concave_distance {

// Level `nodes`: the thesis's niches on the node graphs.

/// Moves every known niche to the minimum below its node pair.
void followNodePairs(const PairFrame& frame, NicheSearch& search, double displacement, double elapsed,
                     NicheArchive& archive, SearchCost& cost, WorkLimit& limit);

/// Makes what was found a niche or counts it to one within the niche radius (greedy identification,
/// Carretero sec. 4.6.4, over time); then records are united and the nearest improved.
/// @param found node pairs, the nearest first
void admitNodePairs(const PairFrame& frame, const TrackerParameters& parameters, NicheSearch& search,
                    const std::vector<TrialPoint>& found, bool warm, std::uint64_t cycle,
                    NicheArchive& archive, PairSolution& solution);

/// Moves both nodes of a record at once, over three edges on either body, as long as that comes closer (the
/// local search over more than one node that Carretero, sec. 7.1, names): between parallel walls one gene at
/// a time ends on a staircase of shallow minima. For the nearest `count` records; the archive is settled
/// afterwards.
void improveNodePairs(const PairObjective& objective, std::size_t count, NicheArchive& archive,
                      const PairFrame& frame, NodeRings& rings, SearchCost& cost);

/// Strips records within the niche radius of a closer one, as greedy identification does; the older id lives
/// on. The archive must be settled; it is again afterwards.
void uniteWithinRadius(double niche_radius, PairMetric& metric, NicheArchive& archive,
                       std::vector<NicheEvent>& events);

}  // namespace concave_distance
