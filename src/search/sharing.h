#pragma once

#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "trial_point_table.h"

namespace concave_distance {

/// phi = 1 / (d^2 + epsilon^2), the potential fitness of a trial point. The thesis divides a fitness that is
/// to be maximised by the niche count (Carretero, eq. (4.1)); dividing d^2, which is to be minimised, would
/// reward crowds. 1 / d^2 grows as d falls, and (4.4) with it predicts the thesis's Table 5.19.
/// @param epsilon metres; keeps a touching pair from taking the whole wheel. With 0 a pair at distance 0 gets
///        1e200, which does just that.
double potentialFitness(double squared_distance, double epsilon);

/// epsilon of potentialFitness() in metres: the longer of both grids' maximum edge lengths, because smaller
/// differences of distance are the grids'. For the selection of parents and for what a population inherits
/// alike: (4.4) and (6.7) of Carretero speak of the same potential fitness.
double fitnessEpsilon(const BodyMesh& a, const BodyMesh& b);

/// S of Carretero, eq. (4.3): 1 - (delta / radius)^exponent below the radius, else 0.
double sharingValue(double delta, double radius, double exponent);

/// m' of every place in the census (Carretero, eq. (4.2), (4.6)): the sum over all individuals of S(Delta to
/// them), itself included, so at least 1. O(places^2) distances.
/// @param niche_counts beside census.places; keeps its capacity
void nicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric, double sharing_radius,
                 double sharing_exponent, std::vector<double>& niche_counts);

}  // namespace concave_distance
