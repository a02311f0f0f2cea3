#pragma once

#include "base/random_engine.h"
#include "comb_ga_parameters.h"
#include "search/mating.h"
#include "search/pair_objective.h"

namespace concave_distance {

/// Mates gene by gene, by the method given.
/// - Mesh: mate(), along a shortest path on the mesh.
/// - MeshNearFitter: each child's node is any of a shortest path within w times its length of the fitter
///   parent's, w = fitterShare(); without a path as mate().
/// - Phenotypic, with the shares t of mate(): the node nearest to the point at t on the straight line, by
///   enumeration: O(nodes).
/// - Genotypic, the same: the node whose index is nearest to t of the difference of both indices.
Children mateBy(MatingMethod method, const PairObjective& objective, const TrialPoint& parent_1,
                const TrialPoint& parent_2, PairMetric& metric, RandomEngine& engine);

}  // namespace concave_distance
