#pragma once

#include <cstdint>
#include <vector>

#include "basin_memory.h"
#include "pair_metric.h"
#include "trial_point_table.h"

namespace concave_distance {

/// Every buffer of one pair's search; bound to the two bodies, cleared and never freed.
struct SearchWorkspace {
  /// Individuals of a usual warm population and its offspring.
  static constexpr std::size_t kUsualPopulation = 256;
  static constexpr std::uint32_t kFirstBasinsLog2 = 6;  ///< grows with the places that descents pass

  SearchWorkspace(const BodyMesh& a, const BodyMesh& b) : metric(a, b), basins(kFirstBasinsLog2) {}
  /// After a cold run, which meets many more places than the warm runs that follow.
  void shrink() { places.shrink(kUsualPopulation); }
  /// Room for a run that meets this many places and minima; a larger one grows the buffers once more.
  void reserve(std::size_t places) {
    basins.reserve(places);
    this->places.reserve(places, kUsualPopulation);
    for (std::vector<std::uint32_t>* individuals :
         {&order, &population_places, &offspring_places, &selected, &elites, &peaks}) {
      individuals->reserve(kUsualPopulation);
    }
    for (std::vector<double>* values : {&niche_counts, &weights}) values->reserve(kUsualPopulation);
    population.reserve(kUsualPopulation);
    offspring.reserve(kUsualPopulation);
    offspring_is_new.reserve(kUsualPopulation);
    census.reserve(places);
    trail.reserve(places);
  }
  PairMetric metric;
  BasinMemory basins;
  std::vector<TrialPoint> population;
  std::vector<std::uint64_t> trail;
  std::vector<std::uint32_t> order;

  TrialPointTable places;
  std::vector<std::uint32_t> population_places;  ///< of each individual
  Census census;                                 ///< of the population
  std::vector<TrialPoint> offspring;
  std::vector<std::uint32_t> offspring_places;
  std::vector<bool> offspring_is_new;
  std::vector<double> niche_counts;
  std::vector<double> weights;
  std::vector<std::uint32_t> selected;
  std::vector<std::uint32_t> elites;
  std::vector<std::uint32_t> peaks;  ///< places of the niches that are conserved
};

}  // namespace concave_distance
