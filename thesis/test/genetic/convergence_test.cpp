#include "thesis/src/genetic/convergence.h"

#include <gtest/gtest.h>

#include "search/search_fixtures.h"

namespace concave_distance::convergence_test {
namespace {

TEST(Convergence, ComesAfterThatManyGenerationsWithoutANewBestOrNiche) {
  RandomEngine engine(64);
  test::SharedPopulation population;
  population.fill(10, 10, engine);
  ConvergenceCheck check;
  check.reset(3);
  EXPECT_FALSE(check.update(population.census, 0.3, population.places, population.metric));
  EXPECT_FALSE(check.update(population.census, 0.3, population.places, population.metric));
  EXPECT_FALSE(check.update(population.census, 0.3, population.places, population.metric));
  EXPECT_TRUE(check.update(population.census, 0.3, population.places, population.metric))
      << "the third that is like the one before";
  Census fewer;
  fewer.take({population.where[0]}, population.places.size());
  EXPECT_FALSE(check.update(fewer, 0.3, population.places, population.metric))
      << "niches have gone: it counts anew";
  check.reset(0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(check.update(population.census, 0.3, population.places, population.metric)) << "0: never";
  }
}

}  // namespace
}  // namespace concave_distance::convergence_test
