#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"
#include "support/enumeration.h"
#include "support/thesis_scenes.h"
#include "thesis/src/grid/grid_nodes.h"

namespace concave_distance::thesis_scenes_test {
namespace {

// STL carries single precision: 1.6 m with a relative error of 2^-24 at six coordinates of a witness pair.
constexpr double kFileAccuracy = 1e-6;

/// A scene on the thesis's grid.
test::ThesisScene onGrid(const std::string& name, double max_edge_length) {
  test::ThesisScene scene = test::loadThesisScene(name, max_edge_length);
  for (const auto& body : {scene.a, scene.b}) {
    SearchNodes nodes = makeGridNodes(body->surface(), body->options(), body->name());
    body->attach(std::make_unique<BodyGrid>(*body, std::move(nodes)));
  }
  return scene;
}

double exactDistance(const std::string& scene) {
  const test::ThesisScene s = test::loadThesisScene(scene, 10.0);
  return std::sqrt(test::enumerateTrianglePairs(*s.a, *s.b, s.a_from_b).squared_distance);
}

TEST(ThesisGeometry, IsClosedOutwardAndWelded) {
  for (const char* name : {"box", "notched_box", "semi_extruded", "grooved_cylinder", "fixture", "battery"}) {
    const std::string path = test::thesisFile(std::string(name) + ".stl");
    const RepairReport report = repairMesh(importMesh(path), {}, path).report;
    EXPECT_EQ(report.shells, 1u) << name;
    EXPECT_EQ(report.closed_shells, 1u) << name;
    EXPECT_EQ(report.turned_triangles, 0u) << name;
    EXPECT_EQ(report.zero_area_triangles + report.duplicate_triangles, 0u) << name;
    EXPECT_EQ(report.border_edges + report.non_manifold_edges + report.inconsistent_edges, 0u) << name;
  }
}

TEST(ThesisGeometry, HasTheExactDistancesOfTables23And26) {
  EXPECT_NEAR(exactDistance("boxes_position_1"), 0.2984, kFileAccuracy);
  EXPECT_NEAR(exactDistance("boxes_position_2"), 0.0979, kFileAccuracy);
  EXPECT_NEAR(exactDistance("cylinder_position_1"), 0.0394, kFileAccuracy);
  EXPECT_NEAR(exactDistance("cylinder_position_2"), 0.0114, kFileAccuracy);
}

TEST(ThesisBoxes, HaveTheThreeRegionsOfTable42AtGridOneTenth) {
  const test::ThesisScene s = onGrid("boxes_position_1", 0.1);
  // The minima are whole edges, so that one region may make a row of node niches.
  const auto niches = test::enumerateNodeNiches(*s.a, *s.b, s.a_from_b, 0.65, 0.005);
  for (const double region : {0.2984, 0.5245, 0.6096}) {
    const bool found = std::any_of(niches.begin(), niches.end(), [&](const test::NodeNiche& niche) {
      return niche.distance >= region - kFileAccuracy && niche.distance < 1.01 * region;
    });
    EXPECT_TRUE(found) << region;
  }
}

struct GridAndCutoff {
  double max_edge_length;
  double cutoff;  ///< metres; 3 holds every pair of nodes
};
class BatteryAndFixture : public ::testing::TestWithParam<GridAndCutoff> {};

TEST_P(BatteryAndFixture, HaveExactlyNineNichesWithinTwoPerCentOfTable46) {
  const test::ThesisScene s = onGrid("battery_static", GetParam().max_edge_length);
  const auto niches = test::enumerateNodeNiches(*s.a, *s.b, s.a_from_b, GetParam().cutoff, 1e-2);
  const double table[] = {0.0757, 0.1336, 0.1499, 0.2039, 0.2953, 0.2971, 0.3731, 0.3938, 0.4026};
  ASSERT_EQ(niches.size(), std::size(table));
  for (std::size_t i = 0; i < niches.size(); ++i) {
    EXPECT_NEAR(niches[i].distance, table[i], 0.02 * table[i]);
    EXPECT_GT(niches[i].prominence, 0.03);
  }
}

INSTANTIATE_TEST_SUITE_P(AtGrids, BatteryAndFixture,
                         ::testing::Values(GridAndCutoff{0.05, 0.45}, GridAndCutoff{0.1, 3.0}));

TEST(BatteryAndFixtureNiches, LieFartherApartOnTheMeshesThanTheSharingRadius) {
  const test::ThesisScene s = onGrid("battery_static", 0.1);
  const auto niches = test::enumerateNodeNiches(*s.a, *s.b, s.a_from_b, 3.0, 1e-2);
  // Carretero, table 6.1: sigma_s = sigma_n = 0.6, on the sum of both mesh distances (4.5).
  ASSERT_FALSE(gridOf(*s.a).metric().isThinned() || gridOf(*s.b).metric().isThinned());
  for (std::size_t i = 0; i < niches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = gridOf(*s.a).metric().distance(niches[i].node_a, niches[j].node_a) +
                           gridOf(*s.b).metric().distance(niches[i].node_b, niches[j].node_b);
      EXPECT_GT(apart, 0.6) << niches[i].distance << " and " << niches[j].distance;
    }
  }
}

TEST(BatteryAtRest, IsOnePatchOverThePlateHoweverOftenItIsMet) {
  // The battery's bottom lies parallel over the plate, around eight protrusions: one plateau of 160 pairs of
  // triangles, that searches meet in many places.
  const std::vector<Eigen::Isometry3d> manoeuvre = test::readThesisPoses("manoeuvre_200.csv");
  TrackerParameters parameters;
  parameters.largest_niche_count = 1000;
  PairTracker tracker("battery", test::loadThesisBody("fixture", 0.1), test::loadThesisBody("battery", 0.1),
                      parameters);
  PairSolution solution;
  for (std::size_t k = 100; k < manoeuvre.size(); ++k) {
    tracker.update(manoeuvre[k], 0.1 * static_cast<double>(k), solution);
  }
  const Eigen::Isometry3d& rest = manoeuvre.back();
  int patches = 0;
  for (const TrackedNiche& niche : solution.niches) {
    patches += niche.kind == NicheKind::Patch && niche.extent > 0.8 ? 1 : 0;
    if (niche.extent > 0.8) {
      EXPECT_NEAR(niche.distance, rest.translation().z(), 1e-6);
    }
  }
  EXPECT_EQ(patches, 1);
}

}  // namespace
}  // namespace concave_distance::thesis_scenes_test
