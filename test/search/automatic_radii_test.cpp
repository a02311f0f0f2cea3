#include "search/automatic_radii.h"

#include <gtest/gtest.h>

#include "concave_distance/mesh/surface/primitives.h"
#include "search/grid/body_grid.h"
#include "search/grid/geodesic_extent.h"
#include "search/search_scenes.h"

namespace concave_distance::automatic_radii_test {
namespace {

TEST(GeodesicExtent, OfABoxIsTheWayBetweenOppositeCorners) {
  const auto body = test::makeSearchBody(makeBox({1.0, 1.0, 1.0}), 0.2);
  // On the surface it is sqrt(5); along the grid's edges more, at most the three edges of the box.
  const double extent = geodesicExtent(gridOf(*body).graph());
  EXPECT_GE(extent, std::sqrt(5.0));
  EXPECT_LE(extent, 3.0);
}

TEST(GeodesicExtent, IsAveragedOverShellsByTheirNodes) {
  const SurfaceMesh large = test::makeSheet(20, 20, 0.1);
  const SurfaceMesh small = test::makeSheet(1, 1, 0.1);
  const double alone = geodesicExtent(buildNodeGraph(large));
  const double with_small = geodesicExtent(buildNodeGraph(test::makeJoined(large, small, {0, 0, 1})));
  const double of_small = geodesicExtent(buildNodeGraph(small));
  EXPECT_NEAR(with_small, (441.0 * alone + 4.0 * of_small) / 445.0, 1e-9);
}

TEST(Protrusions, OfABoxAreItsCorners) {
  const auto body = test::makeSearchBody(makeBox({1.0, 0.8, 0.6}), 0.1);
  const auto protrusions = findProtrusions(gridOf(*body).graph(), 0.02);
  ASSERT_EQ(protrusions.size(), 8U);
  for (const Protrusion& corner : protrusions) {
    EXPECT_NEAR(gridOf(*body).graph().positions[corner.node.value].cwiseAbs().sum(), 0.5 + 0.4 + 0.3, 1e-12);
  }
}

TEST(Protrusions, OfACombAreItsTeeth) {
  const auto body = test::makeSearchBody(test::makeComb(6), 0.1);
  const auto protrusions = findProtrusions(gridOf(*body).graph(), 0.05);
  // The two outermost ends of the bar belong to the outer teeth's sides; every inner tooth has one tip.
  std::vector<int> of_tooth(6, 0);
  for (const Protrusion& tip : protrusions) {
    const Eigen::Vector3d& p = gridOf(*body).graph().positions[tip.node.value];
    if (p.y() > 0.35) {
      ++of_tooth[static_cast<std::size_t>(p.x() / 0.25 + 1e-9)];
    }
  }
  for (std::size_t tooth = 1; tooth < 5; ++tooth) {
    EXPECT_GE(of_tooth[tooth], 1) << "tooth " << tooth;
  }
}

TEST(AutomaticRadii, GrowWithTheBodies) {
  const auto small = test::makeSearchBody(makeBox({1.0, 1.0, 1.0}), 0.1);
  const auto large = test::makeSearchBody(makeBox({3.0, 3.0, 3.0}), 0.3);
  const NicheRadii of_small = automaticRadii(*small, *small, {});
  const NicheRadii of_large = automaticRadii(*large, *large, {});
  EXPECT_NEAR(of_large.sharing, 3.0 * of_small.sharing, 1e-5 * of_large.sharing) << "a length: scale 3";
  EXPECT_DOUBLE_EQ(of_small.niche, of_small.sharing);
  EXPECT_DOUBLE_EQ(of_small.mating, 1.25 * of_small.sharing);
}

TEST(AutomaticRadii, StayBelowTheSpacingOfTeeth) {
  // Twenty teeth, 0.1 long and wide, 0.05 apart: from tip to tip it is 0.25 and at most a tip's width more,
  // along the edges of a triangular lattice up to 2 / sqrt(3) times that, while a tenth of the way across
  // both is more than 0.4.
  const auto rake = test::makeSearchBody(test::makeComb(20, 0.05, 0.05, 0.1, 0.3), 0.08);
  EXPECT_GT(0.2 * geodesicExtent(gridOf(*rake).graph()), 0.4);
  EXPECT_LE(automaticRadii(*rake, *rake, {}).sharing, 2.0 / std::sqrt(3.0) * 0.3);
}

TEST(AutomaticRadii, SpanSomeEdgesOfACoarseGrid) {
  const auto coarse = test::makeSearchBody(makeBox({1.0, 1.0, 0.02}), 1.0);
  EXPECT_GE(automaticRadii(*coarse, *coarse, {}).sharing, 2.0 * gridOf(*coarse).nodes().max_edge_length);
}

TEST(AutomaticRadii, ExplicitValuesWin) {
  const auto body = test::makeSearchBody(makeBox({1.0, 1.0, 1.0}), 0.2);
  GeneticParameters parameters;
  parameters.sharing_radius = 0.6;
  const NicheRadii radii = automaticRadii(*body, *body, parameters);
  EXPECT_DOUBLE_EQ(radii.sharing, 0.6);
  EXPECT_DOUBLE_EQ(radii.mating, 0.75);
  EXPECT_DOUBLE_EQ(radii.niche, 0.6);
  parameters.mating_radius = 0.4;
  parameters.niche_radius = 1.5;
  EXPECT_DOUBLE_EQ(automaticRadii(*body, *body, parameters).mating, 0.4);
  EXPECT_DOUBLE_EQ(automaticRadii(*body, *body, parameters).niche, 1.5);
}

}  // namespace
}  // namespace concave_distance::automatic_radii_test
