#include "tracking/warm_start.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace concave_distance {
namespace {

std::vector<TrialPoint> nichesAt(const std::vector<double>& distances) {
  std::vector<TrialPoint> niches;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    niches.push_back({NodeIndex{i}, NodeIndex{i}, distances[i] * distances[i]});
  }
  return niches;
}

std::vector<int> copiesOf(const std::vector<TrialPoint>& population, std::size_t niche_count) {
  std::vector<int> copies(niche_count, 0);
  for (const TrialPoint& point : population) {
    ++copies[point.node_a.value];
  }
  return copies;
}

TEST(WarmStart, SharesCopiesInProportionToFitness) {
  // phi = 1/d^2: 4, 1, 1. Eq. (6.8): 3 * 3 = 9 copies, one each, six more shared 4 : 1 : 1.
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  inherit(nichesAt({0.5, 1.0, 1.0}), {3.0, 30}, 0.0, population, scratch);
  EXPECT_EQ(copiesOf(population, 3), (std::vector<int>{5, 2, 2}));
}

TEST(WarmStart, StopsAtTheLimit) {
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  inherit(nichesAt(std::vector<double>(20, 1.0)), {3.0, 30}, 0.0, population, scratch);
  EXPECT_EQ(population.size(), 30U);
  const std::vector<int> copies = copiesOf(population, 20);
  EXPECT_EQ(*std::min_element(copies.begin(), copies.end()), 1);
  EXPECT_EQ(*std::max_element(copies.begin(), copies.end()), 2);
}

TEST(WarmStart, KeepsTheNearestWhenThereAreMoreNichesThanCopies) {
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  inherit(nichesAt({1.0, 2.0, 3.0, 4.0}), {1.0, 2}, 0.0, population, scratch);
  EXPECT_EQ(copiesOf(population, 4), (std::vector<int>{1, 1, 0, 0}));
}

TEST(WarmStart, SurvivesNichesAtDistanceZero) {
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  inherit(nichesAt({0.0, 1.0}), {3.0, 30}, 0.0, population, scratch);
  EXPECT_EQ(copiesOf(population, 2), (std::vector<int>{5, 1}));
}

TEST(WarmStart, InheritsNothingFromNothing) {
  std::vector<TrialPoint> population = nichesAt({1.0});
  std::vector<double> scratch;
  inherit({}, {3.0, 30}, 0.0, population, scratch);
  EXPECT_TRUE(population.empty());
}

}  // namespace
}  // namespace concave_distance
