#include "thesis/src/genetic/comb_ga.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "search/genetic_search.h"
#include "search/search_fixtures.h"
#include "support/enumeration.h"

namespace concave_distance::comb_ga_test {
namespace {

constexpr NichingScheme kSchemes[] = {NichingScheme::None,
                                      NichingScheme::Sharing,
                                      NichingScheme::DynamicSharing,
                                      NichingScheme::DeterministicCrowding,
                                      NichingScheme::DeterministicCrowdingWithSelection,
                                      NichingScheme::SimpleCrowding};

struct Search : test::SearchedPair {
  using SearchedPair::SearchedPair;

  GeneticResult run(const CombGaParameters& parameters, std::uint64_t seed,
                    const std::vector<TrialPoint>& inherited = {}, const GenerationObserver& observer = {}) {
    workspace.basins.clear();
    RandomEngine engine(seed);
    return combGa(objective, parameters, radii, inherited, engine, workspace, observer);
  }
};

CombGaParameters smallRun(NichingScheme scheme) {
  CombGaParameters parameters;
  parameters.population_size = 40;
  parameters.max_generations = 12;
  parameters.mutation_probability = 0.05;
  parameters.scheme = scheme;
  return parameters;
}

TEST(CombGa, IsTheCoresSearchWithTheCoresParameters) {
  Search search(test::facingCombs());
  const CombGaParameters parameters = smallRun(NichingScheme::Sharing);
  search.workspace.basins.clear();
  RandomEngine engine(19);
  GeneticState state(search.objective, parameters, search.radii, engine, search.workspace);
  const SearchCost cost = geneticSearch(state, {});
  const std::vector<TrialPoint> population = search.workspace.population;
  const GeneticResult result = search.run(parameters, 19);
  EXPECT_TRUE(test::samePopulation(population, search.workspace.population));
  EXPECT_EQ(result.cost.evaluations, cost.evaluations);
  EXPECT_EQ(result.cost.descents_joined, cost.descents_joined);
  EXPECT_EQ(result.cost.children, cost.children);
}

TEST(CombGa, OneSeedGivesOneAnswerWhateverRanBefore) {
  Search fresh(test::facingCombs());
  Search used(test::facingCombs());
  for (const NichingScheme scheme : kSchemes) {
    for (const MatingMethod mating :
         {MatingMethod::Mesh, MatingMethod::Phenotypic, MatingMethod::Genotypic}) {
      CombGaParameters parameters = smallRun(scheme);
      parameters.mating = mating;
      used.run(parameters, 1234);  // leaves a warm workspace behind
      const GeneticResult first = used.run(parameters, 7);
      const std::vector<TrialPoint> population = used.workspace.population;
      const GeneticResult second = fresh.run(parameters, 7);
      EXPECT_TRUE(test::samePopulation(population, fresh.workspace.population));
      EXPECT_TRUE(samePlace(first.best, second.best));
      EXPECT_EQ(first.best_generation, second.best_generation);
      EXPECT_EQ(first.cost.evaluations, second.cost.evaluations);
    }
  }
}

TEST(CombGa, WorksOnUnconnectedShellsWithEveryScheme) {
  Search search(test::shellsAndShells());
  for (const NichingScheme scheme : kSchemes) {
    for (const bool local : {true, false}) {
      CombGaParameters parameters = smallRun(scheme);
      parameters.local_optimization = local ? LocalOptimization::Lamarckian : LocalOptimization::None;
      const GeneticResult result = search.run(parameters, 3);
      EXPECT_EQ(search.workspace.population.size(), 40U);
      EXPECT_EQ(result.generations, 12U);
      for (const TrialPoint& point : search.workspace.population) {
        EXPECT_EQ(point.squared_distance, search.objective.squaredDistance(point.node_a, point.node_b));
        EXPECT_EQ(search.workspace.basins.find(point.node_a, point.node_b) >= 0, local);
      }
    }
  }
}

TEST(CombGa, BestNeverGetsWorseBecauseTheEliteStays) {
  Search search(test::hookAndStairs());
  for (const NichingScheme scheme : kSchemes) {
    for (const bool local : {true, false}) {
      CombGaParameters parameters = smallRun(scheme);
      parameters.local_optimization = local ? LocalOptimization::Lamarckian : LocalOptimization::None;
      double last = std::numeric_limits<double>::infinity();
      search.run(parameters, 4, {}, [&](const GenerationRecord& record) {
        const TrialPoint& best = *std::min_element(record.population->begin(), record.population->end());
        EXPECT_LE(best.squared_distance, last);
        EXPECT_TRUE(samePlace(best, *record.best_so_far));
        last = best.squared_distance;
      });
    }
  }
}

TEST(CombGa, ObserverSeesEveryGenerationAndTheResultNamesTheOneOfTheBest) {
  Search search(test::facingCombs());
  std::vector<double> best;
  const GeneticResult result =
      search.run(smallRun(NichingScheme::Sharing), 5, {}, [&](const GenerationRecord& record) {
        EXPECT_EQ(record.generation, best.size());
        best.push_back(record.best_so_far->squared_distance);
      });
  ASSERT_EQ(best.size(), 13U);
  const auto first = std::find(best.begin(), best.end(), result.best.squared_distance);
  EXPECT_EQ(result.best_generation, static_cast<std::uint32_t>(first - best.begin()));
}

TEST(CombGa, BaldwinianIndividualsStayAndCountAsFitAsTheMinimumBelowThem) {
  Search search(test::facingCombs());
  CombGaParameters parameters = smallRun(NichingScheme::None);
  parameters.local_optimization = LocalOptimization::Baldwinian;
  const GeneticResult result = search.run(parameters, 6);
  EXPECT_EQ(result.best.squared_distance,
            search.objective.squaredDistance(result.best.node_a, result.best.node_b));
  std::vector<std::uint64_t> trail;
  std::size_t above = 0;
  for (const TrialPoint& point : search.workspace.population) {
    SearchCost cost;
    const TrialPoint minimum = descend(search.objective, point, nullptr, trail, cost);
    EXPECT_EQ(point.squared_distance, minimum.squared_distance);
    EXPECT_LE(result.best.squared_distance, point.squared_distance);
    above += samePlace(point, minimum) ? 0 : 1;
  }
  EXPECT_GT(above, search.workspace.population.size() / 2);
}

TEST(CombGa, GenerationGapReplacesThatManyAtMost) {
  Search search(test::hookAndStairs());
  CombGaParameters parameters = smallRun(NichingScheme::Sharing);
  parameters.local_optimization = LocalOptimization::None;  // individuals stay apart
  parameters.random_immigrants = 0;
  parameters.elite_count = 0;  // elites, immigrants and conserved niches take further seats
  parameters.conserve_niches = false;
  parameters.generation_gap = 0.25;
  for (const NichingScheme scheme :
       {NichingScheme::None, NichingScheme::Sharing, NichingScheme::DeterministicCrowding}) {
    parameters.scheme = scheme;
    std::vector<TrialPoint> before;
    std::size_t most_changed = 0;
    search.run(parameters, 9, {}, [&](const GenerationRecord& record) {
      std::size_t changed = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        changed += samePlace(before[i], (*record.population)[i]) ? 0 : 1;
      }
      EXPECT_LE(changed, 10U);
      most_changed = std::max(most_changed, changed);
      before = *record.population;
    });
    EXPECT_GT(most_changed, 0U);
  }
}

TEST(CombGa, StopsWhenNothingChangesAnyMore) {
  Search search(test::hookAndStairs());
  CombGaParameters parameters = smallRun(NichingScheme::None);
  parameters.max_generations = 500;
  parameters.mutation_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.convergence_generations = 5;
  const GeneticResult result = search.run(parameters, 10);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.generations, 100U);
  parameters.convergence_generations = 0;
  EXPECT_EQ(search.run(parameters, 10).generations, 500U);
}

// The measure of Carretero, sec. 5.1.1: the enumerated optimum. The share asked for is below what is measured
// (49 or 50 of 50), so that a change of the random stream does not fail the test.
TEST(CombGa, FindsTheEnumeratedOptimum) {
  for (const bool is_thinned : {false, true}) {  // the mesh metric
    Search search(test::facingCombs(0.1, is_thinned ? 100 : 65535));
    const TrialPoint optimum =
        test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b);
    for (const NichingScheme scheme : kSchemes) {
      CombGaParameters parameters = smallRun(scheme);
      parameters.population_size = 80;
      int found = 0;
      constexpr int kRuns = 50;
      for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
        found += search.run(parameters, seed).best.squared_distance == optimum.squared_distance ? 1 : 0;
      }
      EXPECT_GE(found, kRuns * 9 / 10) << "scheme " << static_cast<int>(scheme);
    }
  }
}

// What scheme is for: the final population still stands in the niches that the run has met.
TEST(CombGa, SharingKeepsNichesThatPlainEvolutionLoses) {
  Search search(test::facingCombs());
  const double cutoff =
      2.0 *
      std::sqrt(
          test::enumerateNodePairs(*search.scene.a, *search.scene.b, search.scene.a_from_b).squared_distance);
  const std::vector<test::NodeNiche> niches =
      test::enumerateNodeNiches(*search.scene.a, *search.scene.b, search.scene.a_from_b, cutoff, 0.1);
  ASSERT_GE(niches.size(), 4U);
  const auto recall = [&](const CombGaParameters& parameters) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      search.run(parameters, seed);
      const auto is_kept = [&](const test::NodeNiche& niche) {
        return std::any_of(search.workspace.population.begin(), search.workspace.population.end(),
                           [&](const TrialPoint& point) {
                             return point.node_a == niche.node_a && point.node_b == niche.node_b;
                           });
      };
      sum += static_cast<double>(std::count_if(niches.begin(), niches.end(), is_kept));
    }
    return sum / (20.0 * static_cast<double>(niches.size()));
  };
  CombGaParameters parameters = smallRun(NichingScheme::None);
  parameters.population_size = 100;
  parameters.random_immigrants = 0;
  parameters.exchange_probability = 0.0;  // which brings back what has been lost
  const double plain = recall(parameters);
  parameters.scheme = NichingScheme::Sharing;
  parameters.conserve_niches = false;
  const double shared = recall(parameters);
  parameters.conserve_niches = true;
  const double conserved = recall(parameters);
  EXPECT_LT(plain, 0.6);
  EXPECT_GT(shared, 1.3 * plain);
  EXPECT_GE(conserved, shared);
  EXPECT_GT(conserved, 0.95);
}

// The first descent that reaches the limit is the last: any limit between the one given and what was spent
// ends the same run after the same descent.
TEST(CombGa, DescendsNoMoreOnceTheEvaluationsAreSpent) {
  Search search(test::hookAndStairs());
  for (const NichingScheme scheme : kSchemes) {
    CombGaParameters parameters = smallRun(scheme);
    parameters.max_generations = 1000;
    for (const std::uint64_t limit : {300U, 3000U, 20000U}) {  // the first within the initial population
      parameters.evaluation_limit = limit;
      const SearchCost cost = search.run(parameters, 14).cost;
      EXPECT_GE(cost.evaluations, limit);
      parameters.evaluation_limit = cost.evaluations;
      const SearchCost again = search.run(parameters, 14).cost;
      EXPECT_EQ(again.evaluations, cost.evaluations) << "scheme " << static_cast<int>(scheme);
      EXPECT_EQ(again.descents, cost.descents);
    }
  }
}

// Carretero, fig. 2.13: individuals are descended after mutation, so the first parents are random points.
TEST(CombGa, TheFirstPopulationMayStayWhereItIs) {
  Search search(test::hookAndStairs());
  CombGaParameters parameters = smallRun(NichingScheme::None);
  parameters.descend_first_population = false;
  parameters.random_immigrants = 0;
  parameters.elite_count = 0;
  std::size_t minima_at_first = 0;
  std::size_t minima_later = 0;
  search.run(parameters, 15, {}, [&](const GenerationRecord& record) {
    for (const TrialPoint& point : *record.population) {
      const TrialPoint bottom = test::descendAnew(search.objective, point);
      const bool is_minimum = samePlace(bottom, point);
      if (record.generation == 0) minima_at_first += is_minimum ? 1 : 0;
      if (record.generation == 1) minima_later += is_minimum ? 1 : 0;
    }
  });
  EXPECT_LT(minima_at_first, 10U);
  EXPECT_EQ(minima_later, parameters.population_size) << "mated, mutated or neither: all are descended";
}

// Carretero, sec. 4.6.3: parents have to lie within the mating radius to be allowed to mate.
TEST(CombGa, StrictlyRestrictedStrangersDoNotMate) {
  Search search(test::facingCombs());
  search.radii.mating = 0.0;  // nobody is near but who stands on the same place, and has nothing to mate
  CombGaParameters parameters = smallRun(NichingScheme::Sharing);
  parameters.mutation_probability = 0.0;
  parameters.exchange_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.max_generations = 5;
  const auto descents = [&](bool strict) {
    parameters.strict_mating_restriction = strict;
    return search.run(parameters, 17).cost.descents;
  };
  EXPECT_EQ(descents(true), parameters.population_size) << "those of the first population";
  EXPECT_GT(descents(false), parameters.population_size);
}

// Carretero, fig. 4.4: the contest of crowding stands between mating and mutation, before the descent.
TEST(CombGa, ChildrenOfTheThesisCompeteBeforeTheyDescend) {
  Search search(test::facingCombs());
  CombGaParameters parameters = smallRun(NichingScheme::DeterministicCrowdingWithSelection);
  parameters.population_size = 10;
  parameters.max_generations = 1;
  parameters.mutation_probability = 0.0;
  parameters.exchange_probability = 0.0;
  parameters.random_immigrants = 0;
  parameters.crossover_probability = 1.0;
  parameters.mating_restriction = false;
  const auto newcomers = [&](NichingScheme scheme) {
    parameters.scheme = scheme;
    std::size_t count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::set<std::pair<std::uint32_t, std::uint32_t>> parents;
      search.run(parameters, seed, {}, [&](const GenerationRecord& record) {
        for (const TrialPoint& point : *record.population) {
          EXPECT_TRUE(samePlace(test::descendAnew(search.objective, point), point)) << "descended in the end";
          const std::pair<std::uint32_t, std::uint32_t> place(point.node_a.value, point.node_b.value);
          if (record.generation == 0) parents.insert(place);
          if (record.generation == 1) count += parents.count(place) == 0 ? 1 : 0;
        }
      });
    }
    return count;
  };
  const std::size_t replaced = newcomers(NichingScheme::None);  // every child stays
  EXPECT_GT(replaced, 20U);
  EXPECT_LT(newcomers(NichingScheme::DeterministicCrowdingWithSelection), replaced / 4)
      << "children that have not been descended lose to parents that have";
}

}  // namespace
}  // namespace concave_distance::comb_ga_test
