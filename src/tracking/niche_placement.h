#pragma once

#include "concave_distance/search/trial_point.h"
#include "concave_distance/tracking/pair_solution.h"
#include "distance/kernels/pair_frame.h"

namespace concave_distance {

using detail::PairFrame;
struct NicheRecord;

/// Gives the node pair as a witness pair, for level `nodes`.
WitnessPair nodeWitness(const PairFrame& frame, const TrialPoint& pair);

/// Finds the node nearest to each witness among those of its triangle's corners: where a search takes a
/// refined niche up again.
TrialPoint nodePairNear(const PairFrame& frame, const WitnessPair& witness);

/// Places a record at a witness: points, distance, normal. Keeps id, birth and flags.
void placeRecord(NicheRecord& record, const PairFrame& frame, const WitnessPair& witness);

/// Keeps the points of a record on their bodies and measures them at the present pose: an upper bound of its
/// minimum.
void carryRecord(NicheRecord& record, const PairFrame& frame);

}  // namespace concave_distance
