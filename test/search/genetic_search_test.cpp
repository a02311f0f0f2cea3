#include "search/genetic_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <utility>

#include "search/grid/body_grid.h"
#include "search/search_fixtures.h"
#include "support/enumeration.h"

namespace concave_distance::genetic_search_test {
namespace {

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

GeneticParameters smallRun() {
  GeneticParameters parameters;
  parameters.population_size = 40;
  parameters.max_generations = 12;
  parameters.mutation_probability = 0.05;
  return parameters;
}

TEST(GeneticSearch, OneSeedGivesOneAnswerWhateverRanBefore) {
  Search fresh(test::facingCombs());
  Search used(test::facingCombs());
  const GeneticParameters parameters = smallRun();
  used.run(parameters, 1234);  // leaves a warm workspace behind
  const SearchCost first = used.run(parameters, 7);
  const SearchCost second = fresh.run(parameters, 7);
  EXPECT_TRUE(test::samePopulation(used.workspace.population, fresh.workspace.population));
  EXPECT_EQ(first.evaluations, second.evaluations);
}

TEST(GeneticSearch, PopulationIsMadeOfTheMinimaMetOnUnconnectedShellsToo) {
  for (const bool is_connected : {true, false}) {
    Search search(is_connected ? test::facingCombs() : test::shellsAndShells());
    EXPECT_EQ(search.run(smallRun(), 3).generations, 12U);
    EXPECT_EQ(search.workspace.population.size(), 40U);
    for (const TrialPoint& point : search.workspace.population) {
      EXPECT_EQ(point.squared_distance, search.objective.squaredDistance(point.node_a, point.node_b));
      EXPECT_GE(search.workspace.basins.find(point.node_a, point.node_b), 0);
    }
  }
}

TEST(GeneticSearch, BestNeverGetsWorseBecauseTheEliteStays) {
  Search search(test::hookAndStairs());
  double last = std::numeric_limits<double>::infinity();
  search.runLooking(smallRun(), 4, [&] {
    EXPECT_LE(search.best().squared_distance, last);
    last = search.best().squared_distance;
  });
}

TEST(GeneticSearch, InheritedPointsAreDescendedAnew) {
  Search search(test::facingCombs());
  const TrialPoint optimum =
      test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b);
  // From a neighbour of the optimum, with a distance that belongs to another pose.
  const NodeIndex beside = gridOf(*search.scene.a).graph().edges.row(optimum.node_a.value)[0].to;
  GeneticParameters parameters = smallRun();
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
  GeneticParameters parameters = smallRun();
  std::vector<TrialPoint> before;
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> peaks;
  search.runLooking(parameters, 11, [&] {
    const std::vector<TrialPoint>& population = search.workspace.population;
    for (std::size_t i = 0; i < std::min<std::size_t>(before.size(), population.size() / 2); ++i) {
      EXPECT_TRUE(std::any_of(population.begin(), population.end(),
                              [&](const TrialPoint& point) { return samePlace(point, before[i]); }))
          << "niche " << i;
    }
    SearchWorkspace& work = search.workspace;
    nichePeaks(work.census, search.radii.niche, work.places, work.metric, order, peaks);
    before.clear();
    for (const std::uint32_t peak : peaks) before.push_back(work.places.point(peak));
  });
}

// The measure of Carretero, sec. 5.1.1: the enumerated optimum. The share asked for is below what is measured
// (49 or 50 of 50), so that a change of the random stream does not fail the test.
TEST(GeneticSearch, FindsTheEnumeratedOptimum) {
  for (const bool is_thinned : {false, true}) {  // the mesh metric
    Search search(test::facingCombs(0.1, is_thinned ? 100 : 65535));
    const TrialPoint optimum =
        test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b);
    GeneticParameters parameters = smallRun();
    parameters.population_size = 80;
    int found = 0;
    constexpr int kRuns = 50;
    for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
      search.run(parameters, seed);
      found += search.best().squared_distance == optimum.squared_distance ? 1 : 0;
    }
    EXPECT_GE(found, kRuns * 9 / 10);
  }
}

// A place that neither mating nor mutation reaches from a population gone to one niche.
TEST(GeneticSearch, ImmigrantsFindWhatNoParentsLeadTo) {
  Search search(test::shellsAndShells());
  GeneticParameters parameters = smallRun();
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
  GeneticParameters parameters = smallRun();
  parameters.population_size = 100;
  const auto met = [&](double exchange_probability, std::uint64_t seed) {
    parameters.exchange_probability = exchange_probability;
    search.workspace.basins.clear();
    RandomEngine engine(seed);
    GeneticState state(search.objective, parameters, search.radii, engine, search.workspace);
    startPopulation(state, {});
    while (state.cost.evaluations < 40000) runGeneration(state);
    return search.workspace.basins.minima().size();
  };
  std::size_t without = 0;
  std::size_t with = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    without += met(0.0, seed);
    with += met(0.8, seed);
  }
  EXPECT_GT(with, without);
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
  return parameters;
}

TEST(GeneticSearch, ACertainCoupleHasChildrenWithANodeOfEitherParent) {
  Search search(test::facingCombs());
  const auto below = [&](NodeIndex node_a, NodeIndex node_b) {
    return test::descendAnew(search.objective, {node_a, node_b, 0.0});
  };
  const std::vector<TrialPoint> parents = {below(NodeIndex{3U}, NodeIndex{40U}),
                                           below(NodeIndex{70U}, NodeIndex{11U})};
  const std::vector<TrialPoint> children = {below(parents[0].node_a, parents[1].node_b),
                                            below(parents[1].node_a, parents[0].node_b)};
  for (const TrialPoint& child : children) {
    ASSERT_FALSE(samePlace(child, parents[0]) || samePlace(child, parents[1]));
  }
  const GeneticParameters parameters = abstinentCouple();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const Couples couples : {Couples::AsDrawn, Couples::AtLeastOne}) {
      RandomEngine engine(seed);
      search.workspace.basins.clear();
      GeneticState state(search.objective, parameters, search.radii, engine, search.workspace, nullptr,
                         couples);
      const SearchCost cost = geneticSearch(state, parents);
      EXPECT_EQ(cost.generations, 1U);
      EXPECT_EQ(cost.inherited, 2U);
      const bool breeds = couples == Couples::AtLeastOne;
      EXPECT_EQ(cost.children, breeds ? 2U : 0U);
      EXPECT_EQ(cost.descents, breeds ? 4U : 2U);
      for (const TrialPoint& child : children) {
        EXPECT_EQ(search.workspace.basins.find(child.node_a, child.node_b) >= 0, breeds) << "seed " << seed;
      }
    }
  }
}

TEST(GeneticSearch, ACertainCoupleBreedsOnOnePlaceAndAfterTheTime) {
  Search search(test::facingCombs());
  const std::atomic<bool> stop{true};
  GeneticParameters parameters = abstinentCouple();
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

}  // namespace
}  // namespace concave_distance::genetic_search_test
