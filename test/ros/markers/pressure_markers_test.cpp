// Pressure on the patches: colours, their scale, sizes, and what is drawn where there is none.
#include "ros/markers/pressure_markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ros/box_scene.h"
#include "ros/markers/body_markers.h"
#include "ros/markers/contact_markers.h"
#include "ros/markers/marker_parts.h"
#include "ros/markers/scene_markers.h"
#include "ros/messages/contact_conversions.h"
#include "ros/node/distance_cycle.h"
#include "ros/pair_demands.h"

namespace concave_distance::pressure_markers_test {
namespace {

using test::kContacts;
using test::kIdle;
using visualization_msgs::Marker;

constexpr double kFoundation = 1e9;  // Pa/m
constexpr double kDepth = 0.01;
constexpr double kEnd = 2.0 * kFoundation * kDepth;

/// Cube b of side 1 dips into cube a by a centimetre, along x.
class PressureMarkers : public ::testing::Test {
 protected:
  explicit PressureMarkers(ForceDistribution distribution = ForceDistribution::Pressure) {
    EffectSettings& effects = scene.pairs.edit(0).settings.effects;
    effects.normal_force.emplace();
    effects.normal_force->model = NormalForceModel::ElasticFoundation;
    effects.normal_force->foundation_stiffness = kFoundation;
    effects.normal_force->distribution = distribution;
    cycle.setScene(scene);
    const ros::Time now(100, 0);
    place(buffer, "a", 5.0, now);
    place(buffer, "b", 5.0 + 1.0 - kDepth, now);
    place(buffer, "c", -3.0, now);
    cycle.run({kContacts, kIdle}, now);
    style.scale = 0.01;
    const PublishedPair& pair = *cycle.pairs()[0];
    contacts = toContacts(pair.heading, pair.status, *pair.tracked->effects.contacts(),
                          pair.tracked->input.a_from_b);
  }
  DrawnPressures draw(std::size_t& left) const {
    return pressureMarkers(scene, scene.pairs[0], *cycle.pairs()[0], contacts, style, kEnd, left);
  }

  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
  DistanceCycle cycle{buffer, {"world", 1.0, 1}};
  MarkerStyle style;
  PairContactState contacts;
};

TEST_F(PressureMarkers, ColourEachCornerByItsPressure) {
  std::size_t left = kMostPressureTriangles;
  const DrawnPressures drawn = draw(left);
  ASSERT_EQ(drawn.markers.size(), 1U);
  const Marker& marker = drawn.markers[0];
  EXPECT_EQ(marker.ns, "a/b/pressure");
  EXPECT_EQ(marker.id, emptyContactMarker(contacts, "", 0).id);
  EXPECT_EQ(marker.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_EQ(marker.pose.position.x, 5.0) << "points in a's frame";
  EXPECT_EQ(marker.points.size() % 3, 0U);
  EXPECT_EQ(marker.points.size() / 3, kMostPressureTriangles - left);
  ASSERT_EQ(marker.colors.size(), marker.points.size());
  const auto at = [&](std::size_t k) {
    return Eigen::Vector3d(marker.points[k].x, marker.points[k].y, marker.points[k].z);
  };
  for (std::size_t k = 0; k < marker.points.size(); ++k) {
    const std::size_t first = k - k % 3;
    const Eigen::Vector3d middle = (at(first) + at(first + 1) + at(first + 2)) / 3.0;
    const Eigen::Vector3d p = 0.9 * at(k) + 0.1 * middle;
    const double border = std::min(0.5 - std::abs(p.y()), 0.5 - std::abs(p.z()));
    const auto expected = pressureColor(kFoundation * std::min(kDepth, border), kEnd);
    EXPECT_NEAR(marker.colors[k].r, expected.r, 1e-6);
    EXPECT_NEAR(marker.colors[k].g, expected.g, 1e-6);
    EXPECT_NEAR(marker.colors[k].b, expected.b, 1e-6);
    EXPECT_EQ(marker.colors[k].a, 1.0F);
  }
}

TEST_F(PressureMarkers, ReplaceTheDiscWhereTheyFit) {
  std::size_t left = kMostPressureTriangles;
  const auto has_disc = [&](const DrawnPressures& drawn) {
    const std::vector<Marker> markers = contactMarkers(contacts, drawn.has_marker, style);
    return std::any_of(markers.begin(), markers.end(),
                       [](const Marker& marker) { return marker.ns == "a/b/contact_area"; });
  };
  EXPECT_FALSE(has_disc(draw(left)));
  left = 1;
  const DrawnPressures none = draw(left);
  EXPECT_TRUE(none.markers.empty());
  EXPECT_EQ(left, 1U);
  EXPECT_TRUE(has_disc(none));
}

TEST_F(PressureMarkers, AreOnTheBodyThatIsNotSeenThrough) {
  std::size_t left = kMostPressureTriangles;
  const auto place_of = [&] { return draw(left).markers.at(0).points.at(0).x; };
  scene.bodies.edit(0).colour[3] = 0.2;
  EXPECT_NEAR(place_of(), 0.5 - kDepth, 0.1 * style.scale) << "on b, seen through a";
  scene.bodies.edit(0).colour[3] = 1.0;
  scene.bodies.edit(1).colour[3] = 0.2;
  EXPECT_NEAR(place_of(), 0.5, 0.1 * style.scale);
  scene.bodies.edit(1).in_robot_model = true;
  EXPECT_NEAR(place_of(), 0.5 - kDepth, 0.1 * style.scale) << "rviz draws the robot, opaque or not";
}

TEST_F(PressureMarkers, StandInTheSceneInPlaceOfTheDisc) {
  SceneMarkers drawing;
  std_msgs::Header header;
  header.frame_id = "world";
  header.stamp = ros::Time(100.0);
  std::vector<PairNiches> niches;
  for (const auto& pair : cycle.pairs()) niches.push_back(toNiches(pair->heading, pair->tracked->solution));
  const auto texts = [&](const std::vector<PairContactState>& of_contacts) {
    std::string all;
    for (const Marker& marker :
         drawing.draw(scene, style, cycle.pairs(), niches, of_contacts, header, 1.0).markers) {
      all += marker.ns + ": " + marker.text + "\n";
    }
    return all;
  };
  EXPECT_EQ(texts({}).find("pressure"), std::string::npos);
  const std::string with_contact = texts({contacts});
  EXPECT_NE(with_contact.find("a/b/pressure:"), std::string::npos);
  EXPECT_NE(with_contact.find("up to 10.0 MPa"), std::string::npos) << with_contact;
  EXPECT_EQ(with_contact.find("a/b/contact_area"), std::string::npos);
}

class LumpedMarkers : public PressureMarkers {
 protected:
  LumpedMarkers() : PressureMarkers(ForceDistribution::Lumped) {}
};

TEST_F(LumpedMarkers, HaveNoPressure) {
  std::size_t left = kMostPressureTriangles;
  EXPECT_TRUE(draw(left).markers.empty());
  EXPECT_EQ(largestPressure({contacts}), 0.0);
  EXPECT_EQ(contactLabels({contacts}, 0, style.scale).at(0).text.find("up to"), std::string::npos);
}

TEST_F(PressureMarkers, LabelsSayTheLargestPressure) {
  EXPECT_NEAR(largestPressure({contacts}), kFoundation * kDepth, 1.0);
  const std::string text = contactLabels({contacts}, 0, style.scale).at(0).text;
  EXPECT_NE(text.find("up to 10.0 MPa"), std::string::npos) << text;
}

TEST(PressureScale, EndsAtARoundNumberAndIsKept) {
  PressureScale scale;
  scale.update(0.0, 0.0);
  EXPECT_EQ(scale.end(), 0.0);
  scale.update(1.7e4, 0.0);
  EXPECT_DOUBLE_EQ(scale.end(), 2e4);
  scale.update(0.6e4, 0.0);
  EXPECT_DOUBLE_EQ(scale.end(), 2e4) << "no flicker while a force swings";
  scale.update(2.1e4, 0.0);
  EXPECT_DOUBLE_EQ(scale.end(), 2.5e4);
  scale.update(0.5e4, 0.0);
  EXPECT_DOUBLE_EQ(scale.end(), 5e3);
  scale.update(1.0e4, 3e4);
  EXPECT_DOUBLE_EQ(scale.end(), 3e4) << "as configured";
}

TEST(PressureColor, GrowsBrighterWithThePressureAndEndsAtTheScale) {
  double before = -1.0;
  for (int k = 0; k <= 20; ++k) {
    const auto color = pressureColor(0.05 * k, 1.0);
    const double brightness = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b;
    EXPECT_GT(brightness, before) << k;
    before = brightness;
  }
  EXPECT_EQ(pressureColor(1.0, 1.0), pressureColor(7.0, 1.0));
}

TEST(PressureText, HasThreeDigits) {
  EXPECT_EQ(pressureText(0.0), "0 Pa");
  EXPECT_EQ(pressureText(312.3), "312 Pa");
  EXPECT_EQ(pressureText(12.34e3), "12.3 kPa");
  EXPECT_EQ(pressureText(999.6e3), "1.00 MPa");
  EXPECT_EQ(pressureText(2.1e11), "210 GPa");
}

TEST_F(PressureMarkers, LetOneBodyOfThePairBeSeenThrough) {
  scene.bodies.edit(1).in_robot_model = true;
  const visualization_msgs::MarkerArray message = bodyMarkers(scene);
  ASSERT_EQ(message.markers.size(), 3U) << "a deletion, a and c";
  EXPECT_EQ(message.markers[1].color.a, 0.5F);
  EXPECT_EQ(message.markers[2].color.a, 1.0F) << "c presses on nobody";
}

}  // namespace
}  // namespace concave_distance::pressure_markers_test
