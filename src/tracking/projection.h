#pragma once

#include <vector>

#include "base/side.h"
#include "niche_archive.h"
#include "pair_geometry.h"

namespace concave_distance {

/// Starts of refinements by projection: the closest point of the whole other body to a point, and the closest
/// of the own body to that one. A random node pair has to descend on both bodies; a projected one has half of
/// the problem solved exactly, so that few of them find newborn niches early.

/// From both witnesses of a niche: is there a closer place anywhere opposite? Appends up to two candidates.
void projectWitness(PairGeometry& geometry, const NicheRecord& record,
                    std::vector<NicheCandidate>& candidates);

/// From one node of body A's or B's graph; appends a candidate.
void projectNode(PairGeometry& geometry, Side side, NodeIndex node, std::vector<NicheCandidate>& candidates);

}  // namespace concave_distance
