#include "tracking/warm_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "search/sharing.h"

namespace concave_distance::warm_start_test {
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

TEST(WarmStart, WithoutOneEachTheSharesAreThoseOfTheThesisAlone) {
  // phi = 1/d^2: 100, 1, 1. Eq. (6.8): 9 copies; (6.7): 8.82, 0.09, 0.09.
  const std::vector<TrialPoint> niches = nichesAt({0.1, 1.0, 1.0});
  Inheritance inheritance;
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  inherit(niches, inheritance, 0.0, population, scratch);
  EXPECT_EQ(copiesOf(population, 3), (std::vector<int>{7, 1, 1}));
  inheritance.one_each = false;
  inherit(niches, inheritance, 0.0, population, scratch);
  EXPECT_EQ(copiesOf(population, 3), (std::vector<int>{9, 0, 0}));
}

// (6.7) speaks of the potential fitness that selection has.
TEST(WarmStart, SharesByTheFitnessOfSelection) {
  Inheritance inheritance;
  inheritance.one_each = false;
  std::vector<TrialPoint> population;
  std::vector<double> scratch;
  const double epsilon = 0.75;
  inherit(nichesAt({0.0, 1.0}), inheritance, epsilon, population, scratch);
  const double nearest = potentialFitness(0.0, epsilon);
  const double share = 6.0 * nearest / (nearest + potentialFitness(1.0, epsilon));
  EXPECT_EQ(copiesOf(population, 2)[0], std::lround(share));
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
}  // namespace concave_distance::warm_start_test
