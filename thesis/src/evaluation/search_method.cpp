#include "search_method.h"

#include "island_workspaces.h"
#include "multi_start_descent.h"

namespace concave_distance {
namespace {

const char* nameOf(LocalOptimization local) {
  switch (local) {
    case LocalOptimization::None:
      return "-nl";
    case LocalOptimization::Lamarckian:
      return "-wl";
    case LocalOptimization::Baldwinian:
      return "-bw";
  }
  return "";
}

const char* nameOf(NichingScheme scheme) {
  switch (scheme) {
    case NichingScheme::None:
      return "";
    case NichingScheme::Sharing:
      return "-sh";
    case NichingScheme::DynamicSharing:
      return "-ds";
    case NichingScheme::DeterministicCrowding:
      return "-dc";
    case NichingScheme::DeterministicCrowdingWithSelection:
      return "-dcs";
    case NichingScheme::SimpleCrowding:
      return "-sc";
  }
  return "";
}

/// The part of searchPair() that knows each method.
struct Runner {
  const PairObjective& objective;
  const NicheRadii& radii;
  RandomEngine& engine;
  SearchWorkspace& workspace;
  const SearchObserver& observer;

  SearchOutcome operator()(const CombGaParameters& parameters) const {
    GenerationObserver generations;
    if (observer) {
      generations = [this](const GenerationRecord& record) {
        observer({record.generation, record.population->data(), record.population->size(), record.best_so_far,
                  1.0});
      };
    }
    const GeneticResult result = combGa(objective, parameters, radii, {}, engine, workspace, generations);
    return {result.best, result.best_generation, result.generations, result.cost};
  }

  SearchOutcome operator()(const AnnealingParameters& parameters) const {
    AnnealingObserver iterations;
    if (observer) {
      iterations = [this](const AnnealingRecord& record) {
        observer({record.iteration, record.current, 1, record.best_so_far, record.acceptance_probability});
      };
    }
    const AnnealingResult result = simulatedAnnealing(objective, parameters, engine, workspace, iterations);
    workspace.population.assign(1, result.best);
    return {result.best, result.best_iteration, result.iterations, result.cost};
  }

  SearchOutcome operator()(const MultiStartParameters& parameters) const {
    const GeneticResult result =
        multiStartDescent(objective, parameters.starts, engine, workspace, parameters.evaluation_limit);
    workspace.population.assign(1, result.best);
    return {result.best, 0, 0, result.cost};
  }

  SearchOutcome operator()(const IslandParameters& parameters) const {
    IslandWorkspaces islands(objective.bodyA(), objective.bodyB(), parameters.islands, workspace);
    const GeneticResult result =
        islandSearch(objective, parameters, radii, {}, engine, islands.all()).genetic;
    return {result.best, result.best_generation, result.generations, result.cost};
  }
};

}  // namespace

std::string nameOf(const SearchMethod& method) {
  if (const auto* genetic = std::get_if<CombGaParameters>(&method)) {
    return std::string("comb-GA") + nameOf(genetic->local_optimization) + nameOf(genetic->scheme);
  }
  if (const auto* annealing = std::get_if<AnnealingParameters>(&method)) {
    return annealing->local_optimization ? "comb-SA-wl" : "comb-SA-nl";
  }
  return std::holds_alternative<IslandParameters>(method) ? "islands" : "multi-start descent";
}

SearchOutcome searchPair(const PairObjective& objective, const SearchMethod& method, const NicheRadii& radii,
                         RandomEngine& engine, SearchWorkspace& workspace, const SearchObserver& observer) {
  return std::visit(Runner{objective, radii, engine, workspace, observer}, method);
}

}  // namespace concave_distance
