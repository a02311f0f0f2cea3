#include "search/replacement.h"

#include <gtest/gtest.h>

#include <set>

#include "search/search_fixtures.h"

namespace concave_distance::replacement_test {
namespace {

/// A population over places with the squared distances 0, 1, 2, ...
struct Population {
  TrialPointTable places;
  std::vector<TrialPoint> points;
  std::vector<std::uint32_t> where;
  Census census;

  explicit Population(const std::vector<std::uint32_t>& ranks, std::uint32_t place_count = 10) {
    for (std::uint32_t i = 0; i < place_count; ++i) {
      places.placeOf({NodeIndex{i}, NodeIndex{i}, static_cast<double>(i)});
    }
    for (const std::uint32_t rank : ranks) {
      where.push_back(rank);
      points.push_back(places.point(rank));
    }
    census.take(where, places.size());
  }
};

TEST(Elites, AreTheBestDistinctPlacesInOrder) {
  const Population population({7, 3, 3, 5, 9, 3});
  std::vector<std::uint32_t> elites;
  findElites(population.census, population.places, 3, elites);
  EXPECT_EQ(elites, (std::vector<std::uint32_t>{3, 5, 7}));
  findElites(population.census, population.places, 9, elites);
  EXPECT_EQ(elites.size(), 4U) << "there are only four places";
  findElites(population.census, population.places, 0, elites);
  EXPECT_TRUE(elites.empty());
}

TEST(Elites, TakeTheirSeatFromTheMostCrowdedPlace) {
  Population population({4, 6, 6, 6, 8, 9});
  restoreElites({2, 4}, population.places, population.census, population.points, population.where);
  EXPECT_EQ(population.where, (std::vector<std::uint32_t>{4, 2, 6, 6, 8, 9}))
      << "4 is still there, 2 comes back, and no place is lost for it";
  for (std::size_t i = 0; i < population.where.size(); ++i) {
    EXPECT_TRUE(samePlace(population.points[i], population.places.point(population.where[i])));
  }
  EXPECT_EQ(population.census.counts[population.census.entry_of_place[6]], 2U) << "the census follows";
  EXPECT_EQ(population.census.counts[population.census.entry_of_place[2]], 1U);
}

TEST(Newcomers, AreNotSeatedWhereSomebodyStands) {
  Population population({4, 6, 6});
  EXPECT_TRUE(seatNewcomer(6, {}, population.places, population.census, population.points, population.where));
  EXPECT_EQ(population.where, (std::vector<std::uint32_t>{4, 6, 6}));
  EXPECT_TRUE(seatNewcomer(9, {}, population.places, population.census, population.points, population.where));
  EXPECT_EQ(population.where, (std::vector<std::uint32_t>{4, 9, 6}));
}

TEST(Newcomers, DoNotTakeAnElitesSeat) {
  Population population({4, 6});
  EXPECT_FALSE(
      seatNewcomer(9, {4, 6}, population.places, population.census, population.points, population.where));
  EXPECT_EQ(population.where, (std::vector<std::uint32_t>{4, 6}));
}

TEST(Elites, TakeTheSeatOfTheWorstWhenNobodySharesAPlace) {
  Population population({4, 6, 9, 8});
  restoreElites({1, 9}, population.places, population.census, population.points, population.where);
  EXPECT_EQ(population.where, (std::vector<std::uint32_t>{4, 6, 9, 1})) << "9 is an elite itself";
}

TEST(Elites, MoreThanSeatsKeepTheBest) {
  Population population({5, 6});
  restoreElites({0, 1, 2, 3}, population.places, population.census, population.points, population.where);
  EXPECT_EQ(std::set<std::uint32_t>(population.where.begin(), population.where.end()),
            (std::set<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace concave_distance::replacement_test
