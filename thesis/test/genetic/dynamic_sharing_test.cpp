#include "thesis/src/genetic/dynamic_sharing.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>

#include "search/search_fixtures.h"
#include "search/sharing.h"

namespace concave_distance::dynamic_sharing_test {
namespace {

RC_GTEST_PROP(DynamicSharing, NicheMembersCountEverybodyInTheirNiche, ()) {
  static test::SharedPopulation population;
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  population.fill(60, *rc::gen::inRange(1U, 40U), engine);
  const double radius = *rc::gen::element(0.2, 0.7, 2.0);
  DynamicNicheBuffers buffers;
  std::vector<double> counts;
  const std::uint32_t limit = *rc::gen::element(1U, 3U, 100U);
  dynamicNicheCounts(population.census, population.places, population.metric, radius, 1.0, limit, buffers,
                     counts);

  // Miller and Shaw's procedure, individual by individual.
  std::vector<std::uint32_t> by_fitness(population.where.size());
  for (std::uint32_t i = 0; i < by_fitness.size(); ++i) {
    by_fitness[i] = i;
  }
  std::sort(by_fitness.begin(), by_fitness.end(), [&](std::uint32_t l, std::uint32_t r) {
    return population.places.point(population.where[l]) < population.places.point(population.where[r]);
  });
  std::vector<std::uint32_t> peaks;
  std::vector<int> niche(population.where.size(), -1);
  for (const std::uint32_t i : by_fitness) {
    for (std::size_t k = 0; k < peaks.size() && niche[i] < 0; ++k) {
      niche[i] = population.delta(i, peaks[k]) < radius ? static_cast<int>(k) : -1;
    }
    if (niche[i] < 0 && peaks.size() < limit) {
      niche[i] = static_cast<int>(peaks.size());
      peaks.push_back(i);
    }
  }
  for (std::uint32_t i = 0; i < population.where.size(); ++i) {
    double expected = 0.0;
    for (std::uint32_t j = 0; j < population.where.size(); ++j) {
      expected += niche[i] >= 0 ? (niche[j] == niche[i] ? 1.0 : 0.0)
                                : sharingValue(population.delta(i, j), radius, 1.0);
    }
    const double found = counts[population.census.entry_of_place[population.where[i]]];
    RC_ASSERT(std::abs(found - expected) <= 1e-6 * expected);
  }
}

}  // namespace
}  // namespace concave_distance::dynamic_sharing_test
