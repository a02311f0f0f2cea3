#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

#include "island_search.h"
#include "thesis/src/annealing/simulated_annealing.h"
#include "thesis/src/genetic/comb_ga.h"

namespace concave_distance {

/// Random starts, each descended: what any other method has to beat.
struct MultiStartParameters {
  std::uint32_t starts = 1000;
  std::uint64_t evaluation_limit = 0;  ///< no further start once reached; 0: no limit
};

/// Any search over node pairs, so that each can be compared with the others.
using SearchMethod =
    std::variant<CombGaParameters, AnnealingParameters, MultiStartParameters, IslandParameters>;

/// The thesis's name of a method (Carretero, sec. 2.4): comb-{GA|SA}-{wl|nl}[-sh|-dc], with -bw for the
/// Baldwin variant, -ds for dynamic sharing, -sc for simple crowding; -dc is Mahfoud's deterministic crowding
/// and -dcs the thesis's, which selects the parents. Islands of any of them are "islands".
std::string nameOf(const SearchMethod& method);

/// A generation of a GA or an iteration of the annealing.
struct SearchRecord {
  std::uint32_t iteration;  ///< 0: the initial points
  const TrialPoint* points;
  std::size_t point_count;  ///< the population; 1 for annealing
  const TrialPoint* best_so_far;
  double acceptance_probability;  ///< p_b, of annealing; 1 for the others
};
using SearchObserver = std::function<void(const SearchRecord&)>;

struct SearchOutcome {
  TrialPoint best;
  std::uint32_t best_iteration = 0;  ///< G_i: in which the best appeared
  std::uint32_t iterations = 0;
  SearchCost cost;
};

/// Runs the method from random points. The final population of a GA stays in workspace.population, of the
/// others their best; the minima met in workspace.basins, which the caller clears.
/// @param radii of niching, of a GA alone
SearchOutcome searchPair(const PairObjective& objective, const SearchMethod& method, const NicheRadii& radii,
                         RandomEngine& engine, SearchWorkspace& workspace,
                         const SearchObserver& observer = {});

}  // namespace concave_distance
