// Level `certified` of a running node: proofs, tolerances and budgets on topics, in services and diagnostics.
#include <concave_distance/GetDistance.h>
#include <concave_distance/PairNiches.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "node_access.h"
#include "tf_player.h"

namespace concave_distance::certified_rostest {
namespace {

// Metres, of the battery over the fixture: inserted, near walls on every side.
constexpr double kDepth = 0.15;

GetDistanceRequest insertion() {
  GetDistanceRequest request;
  request.query.body_a = "fixture";
  request.query.body_b = "battery";
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  return request;
}

class CertifiedTest : public ::testing::Test {
 protected:
  CertifiedTest() {
    player.place("fixture", 0.0);
    player.place("battery", 0.0, 0.0, kDepth);
    player.place("crate", 0.0, 10.0);
    player.place("box", 1.5, 10.0);
    EXPECT_TRUE(eventually([] { return call<GetDistance>(kNode + "get_distance", insertion()).success; }));
  }
  // Moves the battery a little, cycle after cycle.
  template <typename Condition>
  bool moveUntil(Condition&& condition) {
    int step = 0;
    return eventually([&] {
      player.place("battery", 0.0, 0.0, kDepth + 0.0005 * (++step % 20));
      return condition();
    });
  }
  TfPlayer player;
};

TEST_F(CertifiedTest, DistancesCarryTheirProofAndWhatItCost) {
  for (const std::string topic : {"distance", "niches"}) {
    const auto is_proven = [](const PairDistance& message) {
      return message.status.code == PairStatus::OK && message.accuracy == PairDistance::ACCURACY_CERTIFIED &&
             message.has_lower_bound && message.lower_bound <= message.distance &&
             message.lower_bound >= message.distance - kRounding && message.cost.box_bounds > 0 &&
             message.cost.triangle_pairs > 0 && message.cost.solve_time > 0.0 &&
             message.has_closing_speed != 0;
    };
    if (topic == "distance") {
      Collector<PairDistance> distances(kNode + "pairs/insertion/distance");
      ASSERT_TRUE(moveUntil([&] { return distances.last() && is_proven(*distances.last()); }));
      EXPECT_EQ(distances.last()->cost.evaluations, 0U)
          << "nothing is searched where no niches are asked for";
    } else {
      Collector<PairNiches> niches(kNode + "pairs/insertion/niches");
      ASSERT_TRUE(moveUntil([&] {
        return niches.last() && is_proven(niches.last()->nearest) && niches.last()->evaluations > 0;
      }));
      const PairNiches message = *niches.last();
      ASSERT_FALSE(message.niches.empty());
      EXPECT_EQ(message.niches.front().distance, message.nearest.distance);
      EXPECT_NE(message.nearest.nearest_niche_id, 0U);
    }
  }
}

TEST_F(CertifiedTest, EveryCycleThatMovesBreedsFromTheLastNiches) {
  Collector<PairNiches> niches(kNode + "pairs/insertion/niches");
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  // The first cycles do without the search, whose grids are made in the background.
  const auto has_bred = [](const PairNiches& message) { return message.nearest.cost.generations > 0; };
  ASSERT_TRUE(moveUntil([&] { return niches.last() && has_bred(*niches.last()); }));
  niches.clear();
  ASSERT_TRUE(moveUntil([&] { return niches.all().size() > 50; }));
  std::size_t bred = 0;
  std::size_t known = 0;
  std::uint64_t last_cycle = 0;
  geometry_msgs::Point last_point;
  for (const PairNiches& message : niches.all()) {
    const SolveCost& cost = message.nearest.cost;
    const bool is_next = known > 0 && message.cycle == last_cycle + 1;
    if (cost.generations > 0) {
      ++bred;
      EXPECT_EQ(cost.generations, 1U);
      EXPECT_GT(cost.children, 0U);
      if (is_next) {
        EXPECT_GT(cost.inherited, 0U) << known << " niches were known";
      }
    } else if (is_next) {
      EXPECT_EQ(message.nearest.point_b.z, last_point.z) << "it has moved and bred nothing";
    }
    known = message.niches.size();
    last_cycle = message.cycle;
    last_point = message.nearest.point_b;
  }
  EXPECT_GT(bred, 10U);
  EXPECT_TRUE(moveUntil(
      [&] { return diagnostics.last() && counted(*diagnostics.last(), "search generations") > 0.0; }));
}

TEST_F(CertifiedTest, APairThatPenetratesNamesTrianglesOrTheDistanceOfTheSurfaces) {
  for (const std::string topic : {"distance", "niches"}) {
    Collector<PairNiches> niches(kNode + "pairs/crate_box/" + (topic == "niches" ? topic : "unused"));
    Collector<PairDistance> distances(kNode + "pairs/crate_box/distance");
    const auto wait_for = [&](std::uint8_t code) {
      return distances.waitFor([code](const PairDistance& message) { return message.status.code == code; });
    };
    player.place("box", 1.5, 10.0);
    ASSERT_TRUE(wait_for(PairStatus::OK));
    PairDistance message = *distances.last();
    EXPECT_NEAR(message.distance, 0.4, kRounding);
    EXPECT_FALSE(message.has_meeting_triangles || message.has_surface_distance);
    EXPECT_TRUE(std::isnan(message.surface_distance));

    player.place("box", 0.2, 10.1);
    ASSERT_TRUE(wait_for(PairStatus::PENETRATING)) << "swallowed";
    message = *distances.last();
    EXPECT_EQ(message.distance, 0.0);
    EXPECT_EQ(message.lower_bound, 0.0);
    EXPECT_FALSE(message.has_meeting_triangles);
    ASSERT_TRUE(message.has_surface_distance);
    EXPECT_NEAR(message.surface_distance, 0.7, 1e-9);

    player.place("box", 1.05, 10.1);
    ASSERT_TRUE(distances.waitFor([](const PairDistance& m) { return m.has_meeting_triangles != 0; }));
    message = *distances.last();
    EXPECT_EQ(message.status.code, PairStatus::PENETRATING);
    EXPECT_EQ(message.distance, 0.0);
    EXPECT_LT(message.triangle_a, 12U);
    EXPECT_LT(message.triangle_b, 12U);
  }
}

TEST_F(CertifiedTest, QueriesStopAProofAtATolerance) {
  GetDistanceRequest request = insertion();
  const auto configured = call<GetDistance>(kNode + "get_distance", request);
  ASSERT_TRUE(configured.success) << configured.message;
  EXPECT_EQ(configured.result.nearest.accuracy, PairDistance::ACCURACY_CERTIFIED);
  EXPECT_EQ(configured.result.nearest.status.code, PairStatus::OK);
  const double distance = configured.result.nearest.distance;
  for (const bool with_niches : {false, true}) {
    request.query.with_niches = static_cast<std::uint8_t>(with_niches);
    request.query.accuracy = DistanceQuery::ACCURACY_CERTIFIED;
    request.query.absolute_tolerance = 0.02;
    const PairDistance loose = call<GetDistance>(kNode + "get_distance", request).result.nearest;
    EXPECT_EQ(loose.status.code, PairStatus::WITHIN_TOLERANCE);
    EXPECT_EQ(loose.accuracy, PairDistance::ACCURACY_CERTIFIED);
    EXPECT_LE(loose.lower_bound, distance);
    EXPECT_GE(loose.lower_bound, loose.distance - 0.02);
    EXPECT_GE(loose.distance, distance - kRounding);
    EXPECT_LT(loose.cost.box_bounds, configured.result.nearest.cost.box_bounds);

    request.query.absolute_tolerance = 0.0;
    request.query.time_budget = 1e-9;
    const auto hasty = call<GetDistance>(kNode + "get_distance", request);
    EXPECT_TRUE(hasty.success) << "a distance between bounds is an answer";
    EXPECT_EQ(hasty.result.nearest.status.code, PairStatus::BUDGET_EXHAUSTED);
    EXPECT_EQ(hasty.result.nearest.accuracy, PairDistance::ACCURACY_REFINED);
    EXPECT_LE(hasty.result.nearest.lower_bound, distance);
    EXPECT_GE(hasty.result.nearest.distance, distance - kRounding);
    request.query.time_budget = 0.0;
  }
}

TEST_F(CertifiedTest, QueriesRefuseTolerancesThatMeanNothing) {
  const auto expect_refusal = [](const GetDistanceRequest& request, const std::string& part) {
    const auto response = call<GetDistance>(kNode + "get_distance", request);
    EXPECT_FALSE(response.success);
    EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
  };
  GetDistanceRequest request = insertion();
  request.query.absolute_tolerance = -0.1;
  expect_refusal(request, "absolute_tolerance");
  request = insertion();
  request.query.time_budget = -1.0;
  expect_refusal(request, "time_budget");
  request = insertion();
  request.query.accuracy = DistanceQuery::ACCURACY_REFINED;
  request.query.relative_tolerance = 0.1;
  expect_refusal(request, "relative_tolerance");
}

TEST_F(CertifiedTest, DiagnosticsCountMissesAndProofsThatABudgetEnded) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Collector<PairNiches> niches(kNode + "pairs/insertion/niches");
  const auto counts = [&](const std::string& key, const std::function<bool(double)>& condition) {
    return moveUntil([&] {
      const auto last = diagnostics.last();
      return last && counted(*last, "solves") > 20 && condition(counted(*last, key));
    });
  };
  EXPECT_TRUE(counts("solves that ended unproven", [](double count) { return count == 0.0; }));
  EXPECT_TRUE(counts("search misses", [](double count) { return count >= 0.0; }));
  reconfigure("time_budget", "1e-6");
  EXPECT_TRUE(counts("solves that ended unproven", [](double count) { return count > 0.0; }));
  reconfigure("time_budget", "none");
  EXPECT_TRUE(counts("solves that ended unproven", [](double count) { return count == 0.0; }));
}

}  // namespace
}  // namespace concave_distance::certified_rostest
