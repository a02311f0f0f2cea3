#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "thesis/src/genetic/comb_ga.h"

namespace concave_distance {

/// A parallel genetic algorithm (Carretero, sec. 7.1.5): the population is divided among islands, each in a
/// thread of its own, and some individuals travel round the ring of islands between epochs.
struct IslandParameters {
  std::uint32_t islands = 2;
  std::uint32_t epochs = 5;     ///< of equal numbers of generations (one at least) and evaluations
  std::uint32_t migrants = 10;  ///< that each island sends to the next one between two epochs
  /// Of all islands together: population, immigrants and evaluations are divided among them.
  CombGaParameters genetic;

  /// @throws Error naming the parameter, the value seen and the allowed range
  void validate(const std::string& where) const;
};

struct IslandResult {
  GeneticResult genetic;  ///< the cost is that of all islands
  /// Processor time of the slowest island, epoch by epoch: what a run takes where every island has a core.
  double slowest_seconds = 0.0;
};

/// Runs the islands. All populations, one behind the other, and all minima met end in workspaces[0].
/// The answer does not depend on how threads run.
/// @param inherited dealt out among the islands, one by one
/// @param workspaces one for each island, bound to the pair; the caller clears their basins
IslandResult islandSearch(const PairObjective& objective, const IslandParameters& parameters,
                          const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                          RandomEngine& engine, const std::vector<SearchWorkspace*>& workspaces);

}  // namespace concave_distance
