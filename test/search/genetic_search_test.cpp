#include "search/genetic_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <utility>

#include "search/grid/body_grid.h"
#include "search/niche_identification.h"
#include "search/search_fixtures.h"
#include "support/enumeration.h"

namespace concave_distance::genetic_search_test {
namespace {

constexpr NichingMethod kNichings[] = {NichingMethod::Sharing, NichingMethod::DeterministicCrowding};

struct Search : test::SearchedPair {
  using SearchedPair::SearchedPair;

  SearchCost run(const GeneticParameters& parameters, std::uint64_t seed,
                 const std::vector<TrialPoint>& inherited = {}) {
    workspace.basins.clear();
    RandomEngine engine(seed);
    GeneticState state(objective, parameters, radii, engine, workspace);
    return geneticSearch(state, inherited);
  }
  /// Calls look() after every generation, the first population included.
  template <typename Look>
  void runLooking(const GeneticParameters& parameters, std::uint64_t seed, const Look& look) {
    workspace.basins.clear();
    RandomEngine engine(seed);
    GeneticState state(objective, parameters, radii, engine, workspace);
    startPopulation(state, {});
    look();
    while (state.cost.generations < parameters.max_generations) {
      runGeneration(state);
      look();
    }
  }
  TrialPoint best() const {
    return *std::min_element(workspace.population.begin(), workspace.population.end());
  }
};

/// Individuals stay where they are.
struct StayingState : GeneticState {
  using GeneticState::GeneticState;
  void settle(TrialPoint& point, std::uint32_t& place) override {
    point = objective.evaluate(point.node_a, point.node_b, cost);
    place = work.places.placeOf(point);
  }
};

GeneticParameters smallRun(NichingMethod niching) {
  GeneticParameters parameters;
  parameters.population_size = 40;
  parameters.max_generations = 12;
  parameters.mutation_probability = 0.05;
  parameters.niching = niching;
  return parameters;
}

TEST(GeneticSearch, OneSeedGivesOneAnswerWhateverRanBefore) {
  Search fresh(test::facingCombs());
  Search used(test::facingCombs());
  for (const NichingMethod niching : kNichings) {
    const GeneticParameters parameters = smallRun(niching);
    used.run(parameters, 1234);  // leaves a warm workspace behind
    const SearchCost first = used.run(parameters, 7);
    const SearchCost second = fresh.run(parameters, 7);
    EXPECT_TRUE(test::samePopulation(used.workspace.population, fresh.workspace.population));
    EXPECT_EQ(first.evaluations, second.evaluations);
  }
}

TEST(GeneticSearch, PopulationIsMadeOfTheMinimaMetOnUnconnectedShellsToo) {
  for (const bool is_connected : {true, false}) {
    Search search(is_connected ? test::facingCombs() : test::shellsAndShells());
    for (const NichingMethod niching : kNichings) {
      EXPECT_EQ(search.run(smallRun(niching), 3).generations, 12U);
      EXPECT_EQ(search.workspace.population.size(), 40U);
      for (const TrialPoint& point : search.workspace.population) {
        EXPECT_EQ(point.squared_distance, search.objective.squaredDistance(point.node_a, point.node_b));
        EXPECT_GE(search.workspace.basins.find(point.node_a, point.node_b), 0);
      }
    }
  }
}

TEST(GeneticSearch, BestNeverGetsWorseBecauseTheEliteStays) {
  Search search(test::hookAndStairs());
  for (const NichingMethod niching : kNichings) {
    double last = std::numeric_limits<double>::infinity();
    search.runLooking(smallRun(niching), 4, [&] {
      EXPECT_LE(search.best().squared_distance, last);
      last = search.best().squared_distance;
    });
  }
}

TEST(GeneticSearch, InheritedPointsAreDescendedAnew) {
  Search search(test::facingCombs());
  const TrialPoint optimum =
      test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b);
  // From a neighbour of the optimum, with a distance that belongs to another pose.
  const NodeIndex beside = gridOf(*search.scene.a).graph().edges.row(optimum.node_a.value)[0].to;
  GeneticParameters parameters = smallRun(NichingMethod::Sharing);
  parameters.max_generations = 0;
  const SearchCost cost = search.run(parameters, 8, {{beside, optimum.node_b, 1e-30}});
  EXPECT_EQ(search.best().squared_distance, optimum.squared_distance);
  EXPECT_EQ(cost.generations, 0U);
  EXPECT_EQ(search.workspace.population.size(), 40U);
  const std::vector<TrialPoint> too_many(100, search.best());
  search.run(parameters, 8, too_many);
  EXPECT_EQ(search.workspace.population.size(), 40U);
}

TEST(GeneticSearch, ConservedNichesAreNeverLost) {
  Search search(test::facingCombs());
  GeneticParameters parameters = smallRun(NichingMethod::Sharing);
  parameters.conserve_niches = true;
  std::vector<IdentifiedNiche> before;
  std::vector<std::uint32_t> order;
  search.runLooking(parameters, 11, [&] {
    const std::vector<TrialPoint>& population = search.workspace.population;
    for (std::size_t i = 0; i < std::min<std::size_t>(before.size(), population.size() / 2); ++i) {
      EXPECT_TRUE(std::any_of(population.begin(), population.end(),
                              [&](const TrialPoint& point) { return samePlace(point, before[i].best); }))
          << "niche " << i;
    }
    identifyNiches(population, search.radii.niche, search.workspace.metric, before, order);
  });
}

// The measure of Carretero, sec. 5.1.1: the enumerated optimum. The share asked for is below what is measured
// (49 or 50 of 50), so that a change of the random stream does not fail the test.
TEST(GeneticSearch, FindsTheEnumeratedOptimum) {
  for (const bool on_demand : {false, true}) {
    Search search(test::facingCombs(0.1, on_demand ? 0 : 65535));
    const TrialPoint optimum =
        test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b);
    for (const NichingMethod niching : kNichings) {
      GeneticParameters parameters = smallRun(niching);
      parameters.population_size = 80;
      int found = 0;
      constexpr int kRuns = 50;
      for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
        search.run(parameters, seed);
        found += search.best().squared_distance == optimum.squared_distance ? 1 : 0;
      }
      EXPECT_GE(found, kRuns * 9 / 10) << "niching " << static_cast<int>(niching);
    }
  }
}

// A place that neither mating nor mutation reaches from a population gone to one niche.
TEST(GeneticSearch, ImmigrantsFindWhatNoParentsLeadTo) {
  Search search(test::shellsAndShells());
  GeneticParameters parameters = smallRun(NichingMethod::Sharing);
  parameters.mutation_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.max_generations = 0;
  search.run(parameters, 13);
  const TrialPoint somewhere = search.best();
  const std::vector<TrialPoint> inherited(parameters.population_size, somewhere);
  parameters.max_generations = 30;
  search.run(parameters, 13, inherited);
  EXPECT_EQ(search.workspace.basins.minima().size(), 1U);
  parameters.random_immigrants = 3;
  search.run(parameters, 13, inherited);
  EXPECT_GT(search.workspace.basins.minima().size(), 5U);
  EXPECT_TRUE(std::any_of(search.workspace.population.begin(), search.workspace.population.end(),
                          [&](const TrialPoint& point) { return !samePlace(point, somewhere); }))
      << "and they are seated";
}

// Niches of two fields of teeth are pairs of teeth: once a tooth has been met, exchange tries it against all.
TEST(GeneticSearch, ExchangeOfGenesMeetsMoreMinimaAtEqualEvaluations) {
  Search search(test::facingCombs());
  GeneticParameters parameters = smallRun(NichingMethod::Sharing);
  parameters.population_size = 100;
  parameters.max_generations = 1000;
  parameters.evaluation_limit = 40000;
  std::size_t without = 0;
  std::size_t with = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    parameters.exchange_probability = 0.0;
    search.run(parameters, seed);
    without += search.workspace.basins.minima().size();
    parameters.exchange_probability = 0.8;
    search.run(parameters, seed);
    with += search.workspace.basins.minima().size();
  }
  EXPECT_GT(with, without);
}

// The first descent that reaches the limit is the last: any limit between the one given and what was spent
// ends the same run after the same descent.
TEST(GeneticSearch, DescendsNoMoreOnceTheEvaluationsAreSpent) {
  Search search(test::hookAndStairs());
  for (const NichingMethod niching : kNichings) {
    GeneticParameters parameters = smallRun(niching);
    parameters.max_generations = 1000;
    for (const std::uint64_t limit : {300U, 3000U, 20000U}) {  // the first within the initial population
      parameters.evaluation_limit = limit;
      const SearchCost cost = search.run(parameters, 14);
      EXPECT_GE(cost.evaluations, limit);
      parameters.evaluation_limit = cost.evaluations;
      const SearchCost again = search.run(parameters, 14);
      EXPECT_EQ(again.evaluations, cost.evaluations) << "niching " << static_cast<int>(niching);
      EXPECT_EQ(again.descents, cost.descents);
    }
  }
}

/// Two individuals who do not mutate, and no draw that lets them mate.
GeneticParameters abstinentCouple() {
  GeneticParameters parameters;
  parameters.population_size = 2;
  parameters.max_generations = 1;
  parameters.crossover_probability = 0.0;
  parameters.mutation_probability = 0.0;
  parameters.exchange_probability = 1.0;
  parameters.random_immigrants = 0;
  parameters.elite_count = 0;
  parameters.conserve_niches = false;
  return parameters;
}

TEST(GeneticSearch, ACertainCoupleHasChildrenWithANodeOfEitherParent) {
  Search search(test::facingCombs());
  const std::vector<TrialPoint> parents = {{NodeIndex{3U}, NodeIndex{40U}, 0.0},
                                           {NodeIndex{70U}, NodeIndex{11U}, 0.0}};
  const std::set<std::pair<std::uint32_t, std::uint32_t>> children = {{3, 11}, {70, 40}};
  const GeneticParameters parameters = abstinentCouple();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const Couples couples : {Couples::AsDrawn, Couples::AtLeastOne}) {
      RandomEngine engine(seed);
      search.workspace.basins.clear();
      StayingState state(search.objective, parameters, search.radii, engine, search.workspace, nullptr,
                         couples);
      const SearchCost cost = geneticSearch(state, parents);
      EXPECT_EQ(cost.generations, 1U);
      EXPECT_EQ(cost.inherited, 2U);
      EXPECT_EQ(cost.children, couples == Couples::AtLeastOne ? 2U : 0U);
      std::set<std::pair<std::uint32_t, std::uint32_t>> population;
      for (const TrialPoint& point : search.workspace.population) {
        population.insert({point.node_a.value, point.node_b.value});
      }
      EXPECT_EQ(population == children, couples == Couples::AtLeastOne) << "seed " << seed;
    }
  }
}

TEST(GeneticSearch, ACertainCoupleBreedsOnOnePlaceAndAfterTheTime) {
  Search search(test::facingCombs());
  const std::atomic<bool> stop{true};
  for (const NichingMethod niching : kNichings) {
    GeneticParameters parameters = abstinentCouple();
    parameters.niching = niching;
    // One niche, twice: the other parent is a newcomer.
    const TrialPoint niche = test::descendAnew(search.objective, {NodeIndex{3U}, NodeIndex{40U}, 0.0});
    for (const bool is_over : {false, true}) {
      WorkLimit limit(WorkLimit::Clock::now(), std::numeric_limits<double>::infinity(), 1U << 30U,
                      is_over ? &stop : nullptr);
      RandomEngine engine(5);
      search.workspace.basins.clear();
      GeneticState state(search.objective, parameters, search.radii, engine, search.workspace, &limit,
                         Couples::AtLeastOne);
      const SearchCost cost = geneticSearch(state, {niche, niche});
      EXPECT_EQ(cost.generations, 1U);
      EXPECT_EQ(cost.children, 2U);
      EXPECT_GT(cost.descents, is_over ? 1U : 2U) << "the parents, and a child at least";
    }
  }
}

}  // namespace
}  // namespace concave_distance::genetic_search_test
