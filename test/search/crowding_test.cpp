#include "search/crowding.h"

#include <gtest/gtest.h>

#include "search/places_on_a_path.h"

namespace concave_distance::crowding_test {
namespace {

using Crowding = test::PlacesOnAPath;

TEST_F(Crowding, PairedContestTakesTheClosestPairing) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  // The children are near the other parent each: crossed they compete.
  competePaired(first, second, at(5, 4.0), at(1, 6.0), places_, metric_);
  EXPECT_EQ(first.point.squared_distance, 5.0) << "its rival (6) was worse";
  EXPECT_EQ(second.point.squared_distance, 4.0) << "replaced by the child near it";
  EXPECT_EQ(second.place, at(5, 4.0).place);
}

TEST_F(Crowding, PairedContestGivesEachParentOneRival) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  // Both children are near the first parent; only one may meet it.
  competePaired(first, second, at(1, 1.0), at(2, 2.0), places_, metric_);
  EXPECT_EQ(first.point.squared_distance, 1.0);
  EXPECT_EQ(second.point.squared_distance, 2.0);
}

TEST_F(Crowding, EqualFitnessReplacesNobody) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  competePaired(first, second, at(1, 5.0), at(5, 5.0), places_, metric_);
  EXPECT_EQ(first.place, at(0, 5.0).place);
  EXPECT_EQ(second.place, at(6, 5.0).place);
}

}  // namespace
}  // namespace concave_distance::crowding_test
