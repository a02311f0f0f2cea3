#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>

#include "search/mating.h"
#include "search/search_fixtures.h"
#include "search/selection.h"

namespace concave_distance::niche_test {
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

RC_GTEST_PROP(PairMetric, AddsBothBodiesAndIsAMetric, ()) {
  static Niches combs(test::facingCombs());
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const auto points = combs.drawPopulation(3, engine);
  const auto delta = [&](std::size_t i, std::size_t j) {
    return combs.metric.distance(points[i], points[j]);
  };
  RC_ASSERT(delta(0, 1) == combs.metric.onA().distance(points[0].node_a, points[1].node_a) +
                               combs.metric.onB().distance(points[0].node_b, points[1].node_b));
  RC_ASSERT(delta(0, 1) == delta(1, 0));
  RC_ASSERT(delta(0, 2) <= (delta(0, 1) + delta(1, 2)) * (1.0 + 0x1.0p-22));
  RC_ASSERT(delta(0, 0) == 0.0);
}

RC_GTEST_PROP(NichePeaks, AreBestStripRepeat, ()) {
  static Niches combs(test::facingCombs());
  static Niches shells(test::shellsAndShells());
  Niches& niches = **rc::gen::element(&combs, &shells);
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const auto population = niches.drawPopulation(40, engine);
  const double radius = *rc::gen::element(0.1, 0.4, 1.0, 3.0);

  // The table keeps distances in single precision: one next to the radius may fall on its other side.
  std::vector<TrialPoint> expected;
  std::vector<TrialPoint> left = population;
  while (!left.empty()) {
    expected.push_back(*std::min_element(left.begin(), left.end()));
    const auto is_stripped = [&](const TrialPoint& point) {
      return static_cast<float>(niches.metric.distance(expected.back(), point)) <= radius;
    };
    left.erase(std::remove_if(left.begin(), left.end(), is_stripped), left.end());
  }

  TrialPointTable places;
  std::vector<std::uint32_t> where;
  for (const TrialPoint& point : population) {
    where.push_back(places.placeOf(point));
  }
  Census census;
  census.take(where, places.size());
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> peaks;
  nichePeaks(census, radius, places, niches.metric, order, peaks);
  RC_ASSERT(peaks.size() == expected.size());
  for (std::size_t i = 0; i < peaks.size(); ++i) RC_ASSERT(samePlace(places.point(peaks[i]), expected[i]));
}

TEST(TrialPointTable, NumbersDistinctTrialPointsAndMeasuresThemOnce) {
  Niches niches(test::facingCombs());
  RandomEngine engine(51);
  const auto population = niches.drawPopulation(200, engine);
  TrialPointTable places;
  for (int run = 0; run < 2; ++run) {  // again after it is cleared
    places.clear();
    std::vector<std::uint32_t> where;
    for (const TrialPoint& point : population) {
      where.push_back(places.placeOf(point));
    }
    for (std::size_t i = 0; i < population.size(); ++i) {
      for (std::size_t j = 0; j < population.size(); ++j) {
        ASSERT_EQ(where[i] == where[j], samePlace(population[i], population[j]));
        const double exact = niches.metric.distance(population[i], population[j]);
        ASSERT_EQ(places.delta(where[i], where[j], niches.metric),
                  static_cast<double>(static_cast<float>(exact)));
      }
    }
  }
}

TEST(TrialPointTable, MeasuresBeyondThePlacesItKeepsDistancesOf) {
  Niches niches(test::facingCombs());
  TrialPointTable places;
  const auto nodes = static_cast<std::uint32_t>(gridOf(*niches.scene.a).graph().nodeCount());
  for (std::uint32_t i = 0; i < 1500; ++i) {
    places.placeOf({NodeIndex{i % nodes}, NodeIndex{i / nodes}, 0.0});
  }
  ASSERT_EQ(places.size(), 1500U);
  const double exact = niches.metric.distance(places.point(3), places.point(1400));
  EXPECT_EQ(places.delta(3, 1400, niches.metric), static_cast<double>(static_cast<float>(exact)));
  EXPECT_EQ(places.delta(1400, 3, niches.metric), places.delta(3, 1400, niches.metric));
}

TEST(Census, CountsWhoStandsWhere) {
  Census census;
  census.take({4, 2, 4, 4, 0}, 5);
  EXPECT_EQ(census.places, (std::vector<std::uint32_t>{4, 2, 0}));
  EXPECT_EQ(census.counts, (std::vector<std::uint32_t>{3, 1, 1}));
  census.take({1}, 3);  // a new run with fewer places
  EXPECT_EQ(census.entry_of_place, (std::vector<std::uint32_t>{Census::kNone, 0, Census::kNone}));
}

TEST(Census, AMoveIsWhatCountingAnewWouldFind) {
  std::vector<std::uint32_t> where{4, 2, 4, 4, 0};
  Census moved;
  moved.take(where, 5);
  const auto move = [&](std::size_t individual, std::uint32_t to) {
    moved.move(where[individual], to, 7);
    where[individual] = to;
    Census counted;
    counted.take(where, 7);
    ASSERT_EQ(moved.places.size(), counted.places.size());
    for (std::uint32_t place = 0; place < 7; ++place) {
      const std::uint32_t entry = moved.entry_of_place[place];
      const std::uint32_t expected = counted.entry_of_place[place];
      ASSERT_EQ(entry == Census::kNone, expected == Census::kNone) << "place " << place;
      if (entry != Census::kNone) {
        EXPECT_EQ(moved.places[entry], place);
        EXPECT_EQ(moved.counts[entry], counted.counts[expected]);
      }
    }
  };
  move(2, 6);  // from a crowd to a place that has come since
  move(1, 3);  // the only one of its place
}

class MatingRestriction : public testing::Test {
 protected:
  MatingRestriction() : niches_(test::facingCombs()) {
    RandomEngine engine(61);
    const auto population = niches_.drawPopulation(40, engine);
    for (const TrialPoint& point : population) {
      where_.push_back(places_.placeOf(point));
    }
  }

  bool near(std::uint32_t i, std::uint32_t j) {
    return places_.delta(where_[i], where_[j], niches_.metric) <= kRadius;
  }

  static constexpr double kRadius = 0.5;
  Niches niches_;
  TrialPointTable places_;
  std::vector<std::uint32_t> where_;
};

TEST_F(MatingRestriction, OnlyRearrangesThePoolAndKeepsFirstParentsTheirSeats) {
  RandomEngine engine(62);
  for (int run = 0; run < 100; ++run) {
    std::vector<std::uint32_t> pool(40);
    for (std::uint32_t i = 0; i < 40; ++i) {
      pool[i] = i;
    }
    shuffle(pool, engine);
    const std::vector<std::uint32_t> before = pool;
    restrictMating(pool, where_, kRadius, places_, niches_.metric, engine);
    EXPECT_EQ(pool[0], before[0]);
    if (near(before[0], before[1])) {
      EXPECT_EQ(pool[1], before[1]) << "a mate within the radius stays";
    }
    std::sort(pool.begin(), pool.end());
    for (std::uint32_t i = 0; i < 40; ++i) {
      ASSERT_EQ(pool[i], i);
    }
  }
}

TEST_F(MatingRestriction, MatesMoreNeighboursThanChanceAndStillSomeStrangers) {
  RandomEngine engine(63);
  int near_by_chance = 0;
  int near_restricted = 0;
  int couples = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<std::uint32_t> pool(40);
    for (std::uint32_t i = 0; i < 40; ++i) {
      pool[i] = i;
    }
    shuffle(pool, engine);
    const auto count_near = [&] {
      int count = 0;
      for (std::size_t i = 0; i < pool.size(); i += 2) {
        count += near(pool[i], pool[i + 1]) ? 1 : 0;
      }
      return count;
    };
    near_by_chance += count_near();
    restrictMating(pool, where_, kRadius, places_, niches_.metric, engine);
    near_restricted += count_near();
    couples += 20;
  }
  EXPECT_GT(near_restricted, near_by_chance * 3 / 2);
  EXPECT_LT(near_restricted, couples) << "two tries, then any";
}

}  // namespace
}  // namespace concave_distance::niche_test
