#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/genetic_parameters.h"
#include "trial_point_table.h"

namespace concave_distance {

/// phi = 1 / (d^2 + epsilon^2), the potential fitness of a trial point. The thesis divides a fitness that is
/// to be maximised by the niche count (Carretero, eq. (4.1)); dividing d^2, which is to be minimised, would
/// reward crowds. 1 / d^2 grows as d falls, and (4.4) with it predicts the thesis's Table 5.19.
/// @param epsilon metres; keeps a touching pair from taking the whole wheel. With 0 a pair at distance 0 gets
///        1e200, which does just that.
double potentialFitness(double squared_distance, double epsilon);

/// epsilon of potentialFitness() in metres: parameters.fitness_epsilon of the longer of both grids' maximum
/// edge lengths. For the selection of parents and for what a population inherits alike: (4.4) and (6.7) of
/// Carretero speak of the same potential fitness.
double fitnessEpsilon(const GeneticParameters& parameters, const BodyMesh& a, const BodyMesh& b);

/// S of Carretero, eq. (4.3): 1 - (delta / radius)^exponent below the radius, else 0.
double sharingValue(double delta, double radius, double exponent);

/// m' of every place in the census (Carretero, eq. (4.2), (4.6)): the sum over all individuals of S(Delta to
/// them), itself included, so at least 1. O(places^2) distances.
/// @param niche_counts beside census.places; keeps its capacity
void nicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric, double sharing_radius,
                 double sharing_exponent, std::vector<double>& niche_counts);

/// Buffers of dynamicNicheCounts(); keep their capacity.
struct DynamicNicheBuffers {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> peaks;
  std::vector<std::uint32_t> peak_of_entry;
};

/// Dynamic niche counts (Miller and Shaw 1996): from the fittest place on, each that is not within the
/// sharing radius of an earlier peak becomes one, until there are `niche_limit`; whoever is within the radius
/// of a peak (of several, the fittest) counts all individuals of that peak's niche, whoever is not shares as
/// above. O(places * peaks) distances while the limit is not reached.
void dynamicNicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric,
                        double sharing_radius, double sharing_exponent, std::uint32_t niche_limit,
                        DynamicNicheBuffers& buffers, std::vector<double>& niche_counts);

}  // namespace concave_distance
