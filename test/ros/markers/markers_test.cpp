#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "concave_distance/mesh/surface/primitives.h"
#include "ros/markers/body_markers.h"
#include "ros/markers/niche_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance::markers_test {
namespace {

using visualization_msgs::Marker;

SceneBody boxBody(const std::string& name, double size) {
  SceneBody body;
  body.name = name;
  body.frame = name + "_frame";
  BodyMeshOptions options;
  options.max_edge_length = size;
  body.mesh = std::make_shared<const BodyMesh>(name, makeBox(Eigen::Vector3d::Constant(size)), options);
  return body;
}

PairNiches pairWithNiches(const std::vector<std::uint64_t>& ids) {
  PairHeading heading;
  heading.pair = "a/b";
  heading.reference_frame = "world";
  heading.with_niches = true;
  PairSolution solution;
  solution.distance = 0.1;
  solution.point_a_in_a.setZero();
  solution.point_b_in_a = Eigen::Vector3d(0.1, 0.0, 0.0);
  for (const std::uint64_t id : ids) {
    TrackedNiche niche;
    niche.id = id;
    niche.distance = 0.1 + 0.1 * static_cast<double>(solution.niches.size());
    niche.point_a_in_a.setZero();
    niche.point_b_in_a = Eigen::Vector3d(niche.distance, 0.0, 0.0);
    niche.normal_in_a = Eigen::Vector3d::UnitX();
    solution.niches.push_back(niche);
  }
  return toNiches(heading, solution);
}

MarkerStyle nicheStyle() {
  MarkerStyle style;
  style.scale = 0.02;
  style.far = 0.5;
  return style;
}

std::vector<Marker> draw(const PairNiches& pair) {
  return nicheMarkers({&pair, pair.niches.size(), true}, nicheStyle());
}

const Marker* find(const std::vector<Marker>& markers, const std::string& ns, int id) {
  for (const Marker& marker : markers) {
    if (marker.ns == ns && marker.id == id) {
      return &marker;
    }
  }
  return nullptr;
}

// The text without the spaces that put it beside its point: more than half as many as it has letters.
std::string wordsOf(const Marker& label) {
  const std::string words = label.text.substr(label.text.find_first_not_of(' '));
  EXPECT_GT(2 * label.text.size(), 3 * words.size());
  return words;
}

TEST(NicheMarkers, CarryTheNichesIdsAndEmphasiseTheNearest) {
  const PairNiches pair = pairWithNiches({41, 7});
  const std::vector<Marker> markers = draw(pair);
  const Marker* nearest = find(markers, "a/b/line", 41);
  const Marker* other = find(markers, "a/b/line", 7);
  ASSERT_TRUE(nearest != nullptr && other != nullptr);
  EXPECT_GT(nearest->scale.x, other->scale.x);
  EXPECT_GT(nearest->color.a, other->color.a);
  EXPECT_EQ(nearest->points.size(), 2U);
  EXPECT_EQ(find(markers, "a/b/points", 41)->type, Marker::SPHERE_LIST);
  EXPECT_EQ(nicheMarkers({&pair, 1}, nicheStyle()).size(), 2U) << "no more niches than asked for";
}

TEST(NicheMarkers, DrawTheNearestOfAllPairsThickAndTheOthersThin) {
  const PairNiches pair = pairWithNiches({41});
  const double thick = find(draw(pair), "a/b/line", 41)->scale.x;
  const std::vector<Marker> other = nicheMarkers({&pair, 1, false}, nicheStyle());
  EXPECT_LT(find(other, "a/b/line", 41)->scale.x, 0.6 * thick);
  EXPECT_EQ(find(other, "a/b/line", 41)->color.a, 1.0F);
}

TEST(NicheLabel, CarriesTheNamesAndTheDistanceOfTheNearestNicheAboveTheMiddleOfItsLine) {
  PairNiches pair = pairWithNiches({41, 7});
  pair.nearest.body_a = "arm";
  pair.nearest.body_b = "shelf";
  const Marker label = nicheLabel(pair, nicheStyle());
  EXPECT_EQ(label.ns, "a/b/text");
  EXPECT_EQ(wordsOf(label), "arm - shelf: 100 mm");
  EXPECT_EQ(label.type, Marker::TEXT_VIEW_FACING);
  EXPECT_NEAR(label.pose.position.x, 0.05, 1e-12);
  EXPECT_EQ(label.pose.position.y, 0.0);
  EXPECT_GE(label.pose.position.z, 0.5 * label.scale.z) << "it covers nothing of the line";
  EXPECT_LE(label.pose.position.z, 2.0 * label.scale.z);
  pair.nearest.status.code = PairStatus::PENETRATING;
  EXPECT_EQ(wordsOf(nicheLabel(pair, nicheStyle())), "arm - shelf: overlap");
}

TEST(NicheMarkers, DashTheLineOfADistanceThatIsNotCertainOrStale) {
  PairNiches pair = pairWithNiches({1, 2});
  EXPECT_EQ(find(draw(pair), "a/b/line", 1)->points.size(), 2U);
  pair.nearest.has_lower_bound = 1;
  pair.nearest.lower_bound = 0.08;
  for (const auto code :
       {PairStatus::BUDGET_EXHAUSTED, PairStatus::MEMORY_EXHAUSTED, PairStatus::WITHIN_TOLERANCE}) {
    pair.nearest.status.code = code;
    const std::vector<Marker> markers = draw(pair);
    const Marker& line = *find(markers, "a/b/line", 1);
    EXPECT_EQ(line.points.size(), 10U);
    EXPECT_NEAR(line.points.back().x, 0.1, 1e-12);
    EXPECT_EQ(find(markers, "a/b/line", 2)->points.size(), 2U);
    const std::string text = nicheLabel(pair, nicheStyle()).text;
    EXPECT_NE(text.find("100 mm, at least 80.0 mm"), std::string::npos) << text;
  }
  pair.nearest.status.code = PairStatus::STALE_TRANSFORM;
  const std::vector<Marker> markers = draw(pair);
  EXPECT_EQ(find(markers, "a/b/line", 1)->points.size(), 10U);
  const std_msgs::ColorRGBA& grey = find(markers, "a/b/line", 1)->color;
  EXPECT_TRUE(grey.r == grey.g && grey.g == grey.b);
  EXPECT_NE(nicheLabel(pair, nicheStyle()).text.find(", stale"), std::string::npos);
}

TEST(NicheMarkers, DrawCirclesOfTheExtentAroundSegmentsAndPatchesAlone) {
  PairNiches pair = pairWithNiches({1, 2});
  pair.niches[1].kind = Niche::KIND_PATCH;
  pair.niches[1].extent = 0.3;
  const std::vector<Marker> markers = draw(pair);
  EXPECT_EQ(find(markers, "a/b/extent", 1), nullptr);
  const Marker* rim = find(markers, "a/b/extent", 2);
  ASSERT_NE(rim, nullptr);
  EXPECT_EQ(rim->type, Marker::LINE_LIST);
  ASSERT_FALSE(rim->points.empty());
  EXPECT_EQ(rim->points.size() % 4, 0U);
  for (std::size_t i = 0; i < rim->points.size(); ++i) {
    const geometry_msgs::Point& centre =
        i < rim->points.size() / 2 ? pair.niches[1].point_a : pair.niches[1].point_b;
    const geometry_msgs::Point& p = rim->points[i];
    EXPECT_NEAR(std::hypot(p.x - centre.x, p.y - centre.y, p.z - centre.z), 0.15, 1e-12);
    EXPECT_NEAR(p.x, centre.x, 1e-12) << "across the normal";
  }
}

TEST(NicheMarkers, DrawAWarningRedAndAPairWithoutADistanceNotAtAll) {
  PairNiches pair = pairWithNiches({1});
  pair.nearest.warning = 1;
  const std::vector<Marker> markers = draw(pair);
  const Marker* line = find(markers, "a/b/line", 1);
  ASSERT_NE(line, nullptr);
  EXPECT_EQ(line->color, warningColor());
  PairStatus stale;
  stale.code = PairStatus::STALE_TRANSFORM;
  EXPECT_FALSE(hasMarkers(emptyNiches(PairHeading(), stale)));
}

TEST(NicheMarkers, DrawTheClosestPointsOfAPairWithoutNiches) {
  const std::vector<Marker> markers = draw(pairWithNiches({}));
  EXPECT_NE(find(markers, "a/b/line", 0), nullptr);
}

TEST(NicheMarkers, AreDeletedOnceWhenTheirNicheDies) {
  ShownMarkers shown;
  std_msgs::Header header;
  header.frame_id = "world";
  withDeletions(draw(pairWithNiches({1, 2})), header, shown);
  const auto second = withDeletions(draw(pairWithNiches({1})), header, shown);
  int deleted = 0;
  for (const Marker& marker : second.markers) {
    if (marker.action == Marker::DELETE) {
      ++deleted;
      EXPECT_EQ(marker.id, 2);
      EXPECT_EQ(marker.header.frame_id, "world");
    }
  }
  EXPECT_EQ(deleted, 2) << "its points and its line";
  const auto third = withDeletions(draw(pairWithNiches({1})), header, shown);
  EXPECT_EQ(third.markers.size(), 2U) << "nothing is deleted twice";
}

TEST(DistanceColor, RunsFromOrangeToGreenWithoutRed) {
  MarkerStyle wide = nicheStyle();
  wide.near = 0.1;
  wide.far = 0.5;
  const auto near = distanceColor(0.0, wide);
  const auto far = distanceColor(2.0, wide);
  EXPECT_GT(near.r, 0.9F);
  EXPECT_GT(near.g, 0.3F) << "red is kept for warnings";
  EXPECT_EQ(far.r, 0.0F);
  EXPECT_GT(far.g, 0.5F);
  EXPECT_GT(distanceColor(0.2, wide).r, distanceColor(0.3, wide).r);
}

TEST(BodyMarkers, ShowWhatTheRobotModelDoesNot) {
  Scene scene;
  scene.bodies.push_back(boxBody("shelf", 1.0));
  scene.bodies.push_back(boxBody("link", 1.0));
  scene.bodies.edit(1).in_robot_model = true;
  const auto message = bodyMarkers(scene);
  ASSERT_EQ(message.markers.size(), 2U);
  EXPECT_EQ(message.markers[0].action, Marker::DELETEALL);
  EXPECT_EQ(message.markers[1].type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(message.markers[1].header.frame_id, "shelf_frame");
  EXPECT_TRUE(message.markers[1].frame_locked);
  EXPECT_EQ(message.markers[1].points.size(), 36U) << "12 triangles";
  const auto with_collision = bodyMarkers(scene, true);
  ASSERT_EQ(with_collision.markers.size(), 3U);
  EXPECT_EQ(with_collision.markers[2].ns, "collision");
  EXPECT_EQ(with_collision.markers[2].header.frame_id, "link_frame");
  EXPECT_LT(with_collision.markers[2].color.a, 0.5F);
}

TEST(BodyMarkers, OfBodiesThatAreOnlyMovedAreThoseOfTheseAlone) {
  Scene shown;
  for (const char* name : {"table", "crate", "link"}) shown.bodies.push_back(boxBody(name, 1.0));
  shown.bodies.edit(2).in_robot_model = true;
  Scene now = shown;
  EXPECT_TRUE(movedBodyMarkers(shown, now)->markers.empty());
  now.bodies.edit(1).frame_from_body.translation().x() = 0.5;
  now.bodies.edit(2).frame = "gripper";
  const auto moved = movedBodyMarkers(shown, now);
  ASSERT_TRUE(moved);
  ASSERT_EQ(moved->markers.size(), 1U);
  EXPECT_EQ(moved->markers[0].id, 1);
  EXPECT_EQ(moved->markers[0].action, Marker::ADD);
  EXPECT_EQ(moved->markers[0].pose.position.x, 0.5);
  EXPECT_EQ(movedBodyMarkers(shown, now, true)->markers.size(), 2U);
  Scene painted = now;
  painted.bodies.edit(0).colour[0] = 0.9;
  EXPECT_FALSE(movedBodyMarkers(shown, painted)) << "another colour";
  Scene more = now;
  more.bodies.push_back(boxBody("new", 1.0));
  EXPECT_FALSE(movedBodyMarkers(shown, more)) << "another body";
}

}  // namespace
}  // namespace concave_distance::markers_test
