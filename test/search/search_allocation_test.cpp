#include <gtest/gtest.h>

#include "search/automatic_radii.h"
#include "search/genetic_search.h"
#include "search/search_scenes.h"
#include "support/count_allocations.h"

namespace concave_distance::search_allocation_test {
namespace {

TEST(SearchAllocation, AWarmRunAllocatesNothing) {
  ASSERT_GT(allocations.load(), 0U) << "the counter is not in place";
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  SearchWorkspace workspace(*scene.a, *scene.b);
  const NicheRadii radii = automaticRadii(*scene.a, *scene.b, {});
  const std::vector<TrialPoint> inherited(10);
  GeneticParameters parameters;
  parameters.population_size = 60;
  parameters.max_generations = 10;
  const auto solve = [&] {
    workspace.basins.clear();
    RandomEngine engine(99);
    GeneticState state(objective, parameters, radii, engine, workspace);
    geneticSearch(state, inherited);
  };
  solve();
  const std::size_t before = allocations.load();
  solve();
  EXPECT_EQ(allocations.load() - before, 0U);
}

}  // namespace
}  // namespace concave_distance::search_allocation_test
