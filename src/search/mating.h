#pragma once

#include <utility>

#include "base/random_engine.h"
#include "concave_distance/search/genetic_parameters.h"
#include "pair_metric.h"
#include "pair_objective.h"

namespace concave_distance {

/// Holds what two parents pass on: node pairs, their distances not yet computed.
using Children = std::pair<TrialPoint, TrialPoint>;

/// Share of the way from the fitter parent to the other that its weight leaves to the first child: f1 / (f1 +
/// f2) of Carretero, eq. (2.15), with the fitter parent's f as f1, so in [0, 1/2]; 1/2 when both are 0.
double fitterShare(double fitter_squared_distance, double other_squared_distance);

/// Mates gene by gene. Eq. (2.15) alone would give one child twice; but for MeshNearFitter both children are
/// drawn, each at a uniformly random share t of the way from the fitter parent to the other: the first with t
/// in [0, w], the second with t in [w, 1], w = fitterShare(). So the first prefers the fitter parent as the
/// thesis has it, and the two together reach all that lies between the parents.
/// - Mesh: the way is a shortest path on the mesh; the first child's node is the last within t times its
///   length of the fitter parent's (so within the radius w times the length), the second's the last within
///   (1 - t) times it of the other parent's. Without a path (between shells, and beyond the
///   matrices also when it is longer than `path_bound`, metres) that gene is copied, the first child from the
///   fitter parent, the second from the other.
/// - MeshNearFitter: each child's node is any within w times the length of the fitter parent's.
/// - Phenotypic: the node nearest to the point at t on the straight line, by enumeration: O(nodes).
/// - Genotypic: the node whose index is nearest to t of the way between both indices.
Children mate(MatingMethod method, const PairObjective& objective, const TrialPoint& parent_1,
              const TrialPoint& parent_2, PairMetric& metric, double path_bound, RandomEngine& engine);

/// Exchange of genes: the first child has `parent_1`'s node on A and `donor_1`'s on B, the second `donor_2`'s
/// on A and `parent_2`'s on B.
Children exchangeGenes(const TrialPoint& parent_1, const TrialPoint& donor_1, const TrialPoint& parent_2,
                       const TrialPoint& donor_2);

}  // namespace concave_distance
