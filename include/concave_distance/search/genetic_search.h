#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "concave_distance/base/random_engine.h"
#include "concave_distance/search/genetic_parameters.h"
#include "concave_distance/search/local_descent.h"
#include "concave_distance/search/niche_identification.h"
#include "concave_distance/search/pair_metric.h"
#include "concave_distance/search/pair_objective.h"

namespace concave_distance {

/// Every buffer of one pair's search; bound to the two bodies, cleared and never freed.
struct SearchWorkspace {
  SearchWorkspace(const BodyMesh& a, const BodyMesh& b) : metric(a, b) {}
  PairMetric metric;
  BasinMemory basins;
  std::vector<TrialPoint> population;
  std::vector<TrialPoint> offspring;
  std::vector<double> fitness;
  std::vector<double> niche_counts;
  std::vector<std::uint32_t> selected;
  std::vector<std::uint32_t> order;
  std::vector<std::uint64_t> trail;
  std::vector<NodeIndex> path;
  std::vector<IdentifiedNiche> niches;

  std::size_t memoryBytes() const;  ///< of all buffers, the metric's cache included
};

/// Watches a run, for figures and tables; called after each generation (0 is the initial population).
struct GenerationRecord {
  std::uint32_t generation;
  const std::vector<TrialPoint>* population;
  const TrialPoint* best_so_far;
};

using GenerationObserver = std::function<void(const GenerationRecord&)>;

struct GeneticResult {
  TrialPoint best;
  std::uint32_t best_generation = 0;  ///< G_i: the generation in which the run's best appeared
  std::uint32_t generations = 0;      ///< run, without the initial one
  bool converged = false;             ///< stopped early by the convergence criterion
  SearchCost cost;
};

/// comb-GA (Carretero, ch. 3 and 4): initial population = `inherited`, the rest random; block order of fig.
/// 4.3 (sharing between evaluation and selection) or fig. 4.4 (crowding between mating and mutation). The
/// final population stays in workspace.population, every local minimum met is added to workspace.basins, which
/// the caller clears once a cycle: basins descended before the call are not descended again.
/// workspace.basins.minima() is
/// (the archive's food) when local optimisation is on. `radii` from automaticRadii().
/// @param observer called once a generation when not empty; the only call that may allocate in a warm run
/// Otherwise allocates only while the workspace warms up. Never throws: parameters were validated.
GeneticResult geneticSearch(const PairObjective& objective, const GeneticParameters& parameters,
                            const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                            RandomEngine& engine, SearchWorkspace& workspace,
                            const GenerationObserver& observer = {});

/// The comparison of the ablation: `descents` random starts, each descended; minima in workspace.basins.
GeneticResult multiStartDescent(const PairObjective& objective, std::uint32_t descents, RandomEngine& engine,
                                SearchWorkspace& workspace);

}  // namespace concave_distance
