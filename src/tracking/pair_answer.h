#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "distance/kernels/minimum_candidate.h"
#include "niche_archive.h"
#include "niche_placement.h"

namespace concave_distance {

/// Empties the answer of the cycle before; its buffers keep their memory.
void clearAnswer(const TrackerParameters& parameters, std::uint64_t cycle, bool is_warm,
                 PairSolution& solution);

/// Lists the niches up to the cutoff, as many as are wanted, and the birth of those that are listed for the
/// first time.
/// @param records ascending by distance
void listNiches(const TrackerParameters& parameters, std::vector<NicheRecord>& records,
                PairSolution& solution);

/// Makes the nearest niche the answer of a level that proves nothing; where one body has swallowed the other,
/// or where the limit left no niche, the nearest minimum.
/// @param known that minimum; nullptr: there is none
/// @param is_round the solids count, not their meshes
void answerByNearest(const PairFrame& frame, const std::vector<NicheRecord>& records,
                     const MinimumCandidate* known, bool is_round, PairSolution& solution, WorkLimit& limit);

/// Brackets the distance by a vertex of each body, where nothing is known and nothing can be allocated.
void answerByVertices(const TrackerParameters& parameters, const BodyMesh& a, const BodyMesh& b,
                      const Eigen::Isometry3d& a_from_b, PairSolution& solution);

/// Returns whether a niche was neither known nor proposed by the search, at a level that proves.
bool hasMissedNiche(const std::vector<TrackedNiche>& niches);

}  // namespace concave_distance
