#include "thesis/src/genetic/niche_identification.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>

#include "search/search_fixtures.h"

namespace concave_distance::niche_identification_test {
namespace {

struct Niches : test::MeasuredPair {
  using MeasuredPair::MeasuredPair;

  std::vector<TrialPoint> drawPopulation(std::uint32_t size, RandomEngine& engine) {
    std::vector<TrialPoint> population;
    std::vector<std::uint64_t> trail;
    SearchCost cost;
    while (population.size() < size) {
      const TrialPoint point = drawPoint(engine);
      population.push_back(uniformUnit(engine) < 0.5 ? descend(objective, point, nullptr, trail, cost)
                                                     : point);
    }
    return population;
  }
};

RC_GTEST_PROP(NicheIdentification, IsBestStripRepeat, ()) {
  static Niches combs(test::facingCombs());
  static Niches shells(test::shellsAndShells());
  Niches& niches = **rc::gen::element(&combs, &shells);
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const auto population = niches.drawPopulation(40, engine);
  const double radius = *rc::gen::element(0.1, 0.4, 1.0, 3.0);

  std::vector<IdentifiedNiche> expected;
  std::vector<TrialPoint> left = population;
  while (!left.empty()) {
    const TrialPoint best = *std::min_element(left.begin(), left.end());
    const auto stays = std::stable_partition(left.begin(), left.end(), [&](const TrialPoint& point) {
      return niches.metric.distance(best, point) > radius;
    });
    expected.push_back({best, static_cast<std::uint32_t>(left.end() - stays)});
    left.erase(stays, left.end());
  }

  std::vector<IdentifiedNiche> found;
  std::vector<std::uint32_t> order;
  identifyNiches(population, radius, niches.metric, found, order);
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    RC_ASSERT(samePlace(found[i].best, expected[i].best));
    RC_ASSERT(found[i].member_count == expected[i].member_count);
  }
}

}  // namespace
}  // namespace concave_distance::niche_identification_test
