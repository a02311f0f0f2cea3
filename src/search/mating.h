#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/search/trial_point.h"
#include "pair_metric.h"
#include "trial_point_table.h"

namespace concave_distance {

/// Pairs up a shuffled mating pool, in place: couple k is entries 2 k and 2 k + 1. The first keeps its seat;
/// its mate is the next in line when both are within `mating_radius` (metres) of each other, else one drawn
/// from those behind, and when that one is too far as well a third, drawn without looking (Carretero, sec.
/// 4.5, 4.6.3, after Deb and Goldberg 1989).
/// @param pool individuals, an even number of them
/// @param population_places the place of each individual
void restrictMating(std::vector<std::uint32_t>& pool, const std::vector<std::uint32_t>& population_places,
                    double mating_radius, TrialPointTable& places, PairMetric& metric, RandomEngine& engine);

/// Holds what two parents pass on: node pairs, their distances not yet computed.
using Children = std::pair<TrialPoint, TrialPoint>;

/// Holds the nodes of both children on one body.
struct Genes {
  NodeIndex first;
  NodeIndex second;
};

/// Says where both children stand between the fitter parent and the other, in [0, 1].
struct Shares {
  double first;
  double second;
};

/// Share of the path from the fitter parent to the other that its weight leaves to the first child: f1 / (f1
/// + f2) of Carretero, eq. (2.15), with the fitter parent's f as f1, so in [0, 1/2]; 1/2 when both are 0.
double fitterShare(double fitter_squared_distance, double other_squared_distance);

/// Holds two parents: the fitter one, of equals the first, and the other.
struct Couple {
  Couple(const TrialPoint& parent_1, const TrialPoint& parent_2);
  /// Draws a first share in [0, share] and a second one in [share, 1].
  Shares drawShares(RandomEngine& engine) const;

  const TrialPoint& fitter;
  const TrialPoint& other;
  double share;  ///< fitterShare()
};

Children childrenOf(const Genes& a, const Genes& b);

/// Mates gene by gene. Eq. (2.15) alone would give one child twice; here each child is drawn at a uniformly
/// random share t of a shortest path on the mesh from the fitter parent to the other: the first with t in [0,
/// w], the second with t in [w, 1], w = fitterShare(). So the first prefers the fitter parent as the thesis
/// has it, and the two together reach all that lies between the parents. The first child's node is the last
/// within t times the path's length of the fitter parent's (so within the radius w times the length), the
/// second's the last within (1 - t) times it of the other parent's. Without a path (between shells) that gene
/// is copied, the first child from the fitter parent, the second from the other.
Children mate(const TrialPoint& parent_1, const TrialPoint& parent_2, PairMetric& metric,
              RandomEngine& engine);

/// Exchange of genes: the first child has `parent_1`'s node on A and `donor_1`'s on B, the second `donor_2`'s
/// on A and `parent_2`'s on B.
Children exchangeGenes(const TrialPoint& parent_1, const TrialPoint& donor_1, const TrialPoint& parent_2,
                       const TrialPoint& donor_2);

}  // namespace concave_distance
