#include "island_search.h"

#include <algorithm>
#include <thread>

#include "base/parameter_checks.h"
#include "base/thread_team.h"
#include "thesis/src/genetic/generation_gap.h"

namespace concave_distance {
namespace {

struct Island {
  RandomEngine engine;
  SearchWorkspace* workspace;
  std::vector<TrialPoint> population;  ///< that its next epoch begins with
  GeneticResult result{};              ///< of the last epoch
  double seconds = 0.0;                ///< of the last epoch
};

/// Every epoch has a generation; a run without any is one epoch.
std::uint32_t epochsOf(const IslandParameters& parameters) {
  return std::clamp(parameters.genetic.max_generations, 1U, parameters.epochs);
}

/// What one island does in one epoch.
CombGaParameters shareOf(const IslandParameters& parameters) {
  CombGaParameters share = parameters.genetic;
  const std::uint32_t islands = parameters.islands;
  share.population_size = std::max(2U, share.population_size / islands / 2 * 2);
  share.random_immigrants = (share.random_immigrants + islands - 1) / islands;
  share.max_generations /= epochsOf(parameters);
  if (share.evaluation_limit != 0) {
    share.evaluation_limit =
        std::max<std::uint64_t>(1, share.evaluation_limit / islands / epochsOf(parameters));
  }
  return share;
}

void runEpoch(const PairObjective& objective, const CombGaParameters& parameters, const NicheRadii& radii,
              Island& island) {
  const std::int64_t start = threadCpuNanoseconds();
  island.result = combGa(objective, parameters, radii, island.population, island.engine, *island.workspace);
  island.population = island.workspace->population;
  island.seconds = 1e-9 * static_cast<double>(threadCpuNanoseconds() - start);
}

/// Individuals drawn from each island take seats drawn on the next one.
void migrate(std::uint32_t migrants, std::vector<Island>& islands) {
  std::vector<std::vector<TrialPoint>> leaving;
  std::vector<std::uint32_t> seats;
  for (Island& island : islands) {
    const auto size = static_cast<std::uint32_t>(island.population.size());
    drawSeats(size, std::min(migrants, size), island.engine, seats);
    leaving.emplace_back();
    for (const std::uint32_t seat : seats) leaving.back().push_back(island.population[seat]);
  }
  for (std::size_t i = 0; i < islands.size(); ++i) {
    Island& next = islands[(i + 1) % islands.size()];
    const auto size = static_cast<std::uint32_t>(next.population.size());
    drawSeats(size, static_cast<std::uint32_t>(leaving[i].size()), next.engine, seats);
    for (std::size_t k = 0; k < leaving[i].size(); ++k) next.population[seats[k]] = leaving[i][k];
  }
}

/// Adds an epoch to the result of all.
void add(const std::vector<Island>& islands, std::uint32_t generations_before, IslandResult& result) {
  double slowest = 0.0;
  std::uint32_t generations = 0;
  for (const Island& island : islands) {
    const GeneticResult& one = island.result;
    if (result.genetic.cost.evaluations == 0 || one.best < result.genetic.best) {
      result.genetic.best = one.best;
      result.genetic.best_generation = generations_before + one.best_generation;
    }
    SearchCost& cost = result.genetic.cost;
    cost.evaluations += one.cost.evaluations;
    cost.descents += one.cost.descents;
    cost.descents_joined += one.cost.descents_joined;
    cost.descent_steps += one.cost.descent_steps;
    slowest = std::max(slowest, island.seconds);
    generations = std::max(generations, one.generations);
  }
  result.genetic.generations = generations_before + generations;
  result.slowest_seconds += slowest;
}

std::vector<Island> settle(const IslandParameters& parameters, const std::vector<TrialPoint>& inherited,
                           RandomEngine& engine, const std::vector<SearchWorkspace*>& workspaces) {
  std::vector<Island> islands;
  for (std::uint32_t i = 0; i < parameters.islands; ++i) {
    islands.push_back({RandomEngine(engine()), workspaces[i], {}});
  }
  for (std::size_t i = 0; i < inherited.size(); ++i) {
    islands[i % islands.size()].population.push_back(inherited[i]);
  }
  return islands;
}

}  // namespace

void IslandParameters::validate(const std::string& where) const {
  if (islands == 0) detail::refuse(where, "islands", "0", "1 or more");
  if (epochs == 0) detail::refuse(where, "epochs", "0", "1 or more");
  genetic.validate(where);
}

IslandResult islandSearch(const PairObjective& objective, const IslandParameters& parameters,
                          const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                          RandomEngine& engine, const std::vector<SearchWorkspace*>& workspaces) {
  const CombGaParameters share = shareOf(parameters);
  std::vector<Island> islands = settle(parameters, inherited, engine, workspaces);
  IslandResult result;
  for (std::uint32_t epoch = 0; epoch < epochsOf(parameters); ++epoch) {
    if (epoch > 0) migrate(parameters.migrants, islands);
    std::vector<std::thread> threads;
    for (Island& island : islands) {
      threads.emplace_back([&] { runEpoch(objective, share, radii, island); });
    }
    for (std::thread& thread : threads) thread.join();
    add(islands, result.genetic.generations, result);
  }
  std::vector<TrialPoint>& all = workspaces[0]->population;
  all.clear();
  for (const Island& island : islands) {
    all.insert(all.end(), island.population.begin(), island.population.end());
    if (island.workspace == workspaces[0]) continue;
    for (const TrialPoint& minimum : island.workspace->basins.minima()) {
      workspaces[0]->basins.addMinimum(minimum);
    }
  }
  return result;
}

}  // namespace concave_distance
