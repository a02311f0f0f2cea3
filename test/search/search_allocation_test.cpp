#include <gtest/gtest.h>

#include "search/automatic_radii.h"
#include "search/genetic_search.h"
#include "search/grid/body_grid.h"
#include "search/niche_identification.h"
#include "search/search_scenes.h"
#include "support/count_allocations.h"

namespace concave_distance::search_allocation_test {
namespace {

TEST(SearchAllocation, AWarmRunAllocatesNothing) {
  ASSERT_GT(allocations.load(), 0U) << "the counter is not in place";
  for (const std::size_t matrix_node_limit : {std::size_t{65535}, std::size_t{0}}) {
    // Without matrices on a grid that has levels, too.
    const test::PairScene scene = test::facingCombs(matrix_node_limit == 0 ? 0.03 : 0.1, matrix_node_limit);
    EXPECT_EQ(gridOf(*scene.a).nodes().levels.levels.empty(), matrix_node_limit != 0);
    const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
    SearchWorkspace workspace(*scene.a, *scene.b);
    const NicheRadii radii = automaticRadii(*scene.a, *scene.b, {});
    const std::vector<TrialPoint> inherited(10);
    for (const NichingMethod niching : {NichingMethod::Sharing, NichingMethod::DeterministicCrowding}) {
      GeneticParameters parameters;
      parameters.population_size = 60;
      parameters.max_generations = 10;
      parameters.niching = niching;
      const auto solve = [&] {
        workspace.basins.clear();
        RandomEngine engine(99);
        GeneticState state(objective, parameters, radii, engine, workspace);
        geneticSearch(state, inherited);
        identifyNiches(workspace.population, radii.niche, workspace.metric, workspace.niches,
                       workspace.order);
      };
      solve();
      const std::size_t before = allocations.load();
      solve();
      EXPECT_EQ(allocations.load() - before, 0U) << "niching " << static_cast<int>(niching);
    }
  }
}

}  // namespace
}  // namespace concave_distance::search_allocation_test
