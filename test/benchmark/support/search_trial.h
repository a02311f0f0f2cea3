#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmark/support/reference_niches.h"
#include "concave_distance/search/genetic_parameters.h"

namespace concave_distance::benchmark {

/// One pose of a pair with the truth that searches are held against.
struct SearchScene {
  Eigen::Isometry3d pose;
  std::vector<ReferenceNiche> references;  ///< ascending by distance on the grid
};

/// Distance up to which niches count: 5 times the pair's least node distance or a quarter of the smaller
/// body's diameter, whichever is larger. Metres.
double truthCutoff(const BenchmarkPair& pair, const Eigen::Isometry3d& pose);

/// `count` instants spread over the pair's motion, each with its truth; instants without any niche below the
/// cutoff are left out.
std::vector<SearchScene> searchScenes(const BenchmarkPair& pair, std::size_t count, double least_prominence);

/// A search to be tried.
struct SearchMethod {
  std::string name;  ///< names the stream of random numbers
  GeneticParameters parameters;
};

/// What a search has met of the truth, as shares of it, and what that cost.
struct SearchOutcome {
  double archive_recall = 0.0;     ///< of all local minima met
  double population_recall = 0.0;  ///< of the final population alone
  double nearest = 0.0;            ///< 1 when the nearest niche is among the minima met
  double microseconds = 0.0;
  double evaluations = 0.0;
};

/// @param sharing_scale factor on all three automatic radii
SearchOutcome trySearch(const BenchmarkPair& pair, const SearchScene& scene, const SearchMethod& method,
                        double sharing_scale, std::uint64_t seed, double least_prominence);

/// The mean over all scenes and `seeds` runs of each, in parallel.
SearchOutcome trySearches(const BenchmarkPair& pair, const std::vector<SearchScene>& scenes,
                          const SearchMethod& method, double sharing_scale, std::uint64_t seeds,
                          double least_prominence);

}  // namespace concave_distance::benchmark
