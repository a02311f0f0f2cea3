// Rules of the picture: which of many pairs are drawn, how numbers are written, which region is shown.
#include <gtest/gtest.h>

#include <cmath>

#include "ros/markers/marker_parts.h"
#include "ros/markers/marker_selection.h"
#include "ros/markers/scene_size.h"

namespace concave_distance::marker_rules_test {
namespace {

TEST(LengthText, HasThreeDigitsInMillimetresOrMetres) {
  EXPECT_EQ(lengthText(0.0), "0 mm");
  EXPECT_EQ(lengthText(3e-6), "<0.01 mm");
  EXPECT_EQ(lengthText(0.000423), "0.42 mm");
  EXPECT_EQ(lengthText(0.0099999), "10.0 mm");
  EXPECT_EQ(lengthText(0.0123), "12.3 mm");
  EXPECT_EQ(lengthText(0.4561), "456 mm");
  EXPECT_EQ(lengthText(0.99949), "999 mm");
  EXPECT_EQ(lengthText(0.9999), "1.00 m");
  EXPECT_EQ(lengthText(1.2449), "1.24 m");
  EXPECT_EQ(lengthText(99.97), "100 m");
  EXPECT_EQ(lengthText(12345.6), "12346 m");
  EXPECT_EQ(forceText(312.3), "312 N");
  EXPECT_EQ(forceText(3581.0), "3.58 kN");
}

TEST(SelectPairs, TakesTheNearestAndThoseInWarning) {
  std::vector<PairNiches> pairs(8);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    pairs[k].nearest.has_distance = 1;
    pairs[k].nearest.distance = 0.8 - 0.1 * static_cast<double>(k);
    pairs[k].niches.resize(3);
    for (std::size_t n = 0; n < 3; ++n) {
      pairs[k].niches[n].distance = pairs[k].nearest.distance + 0.01 * static_cast<double>(n);
    }
  }
  pairs[0].nearest.warning = 1;  // the farthest of all
  pairs[5].niches.clear();       // it has a distance without points
  MarkerStyle style;
  style.pair_count = 3;
  style.niche_count = 6;
  std::vector<const PairNiches*> marked;
  for (const PairNiches& pair : pairs) marked.push_back(&pair);
  const std::vector<DrawnPair> drawn = selectPairs(marked, style);
  ASSERT_EQ(drawn.size(), 4U);
  EXPECT_EQ(drawn[0].pair, &pairs[7]);
  EXPECT_EQ(drawn[1].pair, &pairs[6]);
  EXPECT_EQ(drawn[2].pair, &pairs[4]);
  EXPECT_EQ(drawn[3].pair, &pairs[0]);
  for (const DrawnPair& pair : drawn) EXPECT_EQ(pair.is_nearest, pair.pair == &pairs[7]);
  EXPECT_EQ(drawn[0].niche_count, 3U) << "what the four nearest leave of six goes to the next nearest";
  EXPECT_EQ(drawn[1].niche_count, 1U);
  style.pair_count = style.niche_count = 0;
  const std::vector<DrawnPair> all = selectPairs(marked, style);
  ASSERT_EQ(all.size(), 7U);
  for (const DrawnPair& pair : all) EXPECT_EQ(pair.niche_count, 3U);
}

TEST(UsualRegion, LeavesOutAFloorAndWhatLiesFarOff) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d corner(static_cast<double>(k), 0.0, 0.0);
    boxes.emplace_back(corner, corner + Eigen::Vector3d::Ones());
  }
  const Eigen::AlignedBox3d alone = usualRegion(boxes);
  boxes.emplace_back(Eigen::Vector3d(-15, -15, -0.1), Eigen::Vector3d(15, 15, 0));
  boxes.emplace_back(Eigen::Vector3d(1000, 0, 0), Eigen::Vector3d(1001, 1, 1));
  EXPECT_TRUE(usualRegion(boxes).isApprox(alone));
  EXPECT_TRUE(usualRegion({}).isEmpty());
}

TEST(SceneSize, IsTheDiagonalAndStaysUntilItHasChangedByATenth) {
  const auto cube = [](double side) {
    return std::vector<Eigen::AlignedBox3d>{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(side)}};
  };
  const double size = sceneSize(cube(1.0), 0.0);
  EXPECT_NEAR(size, std::sqrt(3.0), 1e-12);
  EXPECT_EQ(sceneSize(cube(1.09), size), size);
  EXPECT_EQ(sceneSize(cube(0.91), size), size);
  EXPECT_EQ(sceneSize(cube(1.11), size), sceneSize(cube(1.11), 0.0));
  EXPECT_EQ(sceneSize({}, size), size) << "nothing is located";
}

}  // namespace
}  // namespace concave_distance::marker_rules_test
