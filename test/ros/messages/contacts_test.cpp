// Effects in the cycle, contacts as messages and as markers.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "concave_distance/base/error.h"
#include "loading/set_effects.h"
#include "ros/box_scene.h"
#include "ros/markers/contact_markers.h"
#include "ros/messages/contact_conversions.h"
#include "ros/node/distance_cycle.h"
#include "ros/pair_demands.h"
#include "ros/topics/diagnostics.h"

namespace concave_distance::contacts_test {
namespace {

using test::kContacts;
using test::kDistance;
using test::kIdle;
using visualization_msgs::Marker;

constexpr double kSums = 1e-9;

// One region with a force of 10 N along x at (1, 2, 0) of A and 3 N of friction along y.
PairContacts oneContact() {
  PairContacts contacts;
  contacts.possible = true;
  ContactRegion region;
  region.id = 7;
  region.overlap.depth = 0.002;
  region.overlap.contact_area = M_PI * 0.01 * 0.01;
  region.overlap.centroid_in_a = region.point_in_a = Eigen::Vector3d(1.0, 2.0, 0.0);
  region.overlap.normal_in_a = Eigen::Vector3d::UnitX();
  region.overlap.point_a_in_a = Eigen::Vector3d(1.001, 2.0, 0.0);
  region.overlap.point_b_in_a = Eigen::Vector3d(0.999, 2.0, 0.0);
  region.depth_rate = 0.5;
  region.sliding_in_a = Eigen::Vector3d(0.0, -0.1, 0.0);
  region.normal_force = 10.0;
  region.force_direction_in_a = region.overlap.normal_in_a;
  region.friction_on_b_in_a = Eigen::Vector3d(0.0, 3.0, 0.0);
  const Eigen::Vector3d force(10.0, 3.0, 0.0);
  region.on_b_in_a = wrenchAbout(force, region.point_in_a, Eigen::Vector3d::Zero());
  contacts.on_b_in_a = region.on_b_in_a;
  contacts.regions.push_back(region);
  return contacts;
}

PairHeading quarterTurn() {
  PairHeading heading;
  heading.pair = "a/b";
  heading.reference_frame = "world";
  heading.reference_from_a =
      Eigen::Translation3d(10.0, 0.0, 0.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  return heading;
}

PairContactState message() {
  return toContacts(quarterTurn(), PairStatus(), oneContact(),
                    Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0)));
}

TEST(ToContacts, GivesPointsInTheReferenceFrameAndWrenchesAboutTheOriginOfB) {
  const PairContactState state = message();
  ASSERT_EQ(state.contacts.size(), 1U);
  const Contact& contact = state.contacts[0];
  EXPECT_EQ(contact.id, 7U);
  EXPECT_NEAR(contact.centroid.x, 8.0, kSums);
  EXPECT_NEAR(contact.centroid.y, 1.0, kSums);
  EXPECT_NEAR(contact.normal.y, 1.0, kSums);
  EXPECT_NEAR(contact.sliding_velocity.x, 0.1, kSums);
  EXPECT_NEAR(contact.friction.x, -3.0, kSums);
  EXPECT_NEAR(contact.wrench.force.y, 10.0, kSums);
  // (0, 2, 0) x (10, 3, 0): of the point where it acts from B's origin.
  EXPECT_NEAR(contact.wrench.torque.z, -20.0, kSums);
  EXPECT_NEAR(state.wrench.torque.z, -20.0, kSums);
  EXPECT_NEAR(state.wrench_point.x, 10.0, kSums);
  EXPECT_NEAR(state.wrench_point.y, 1.0, kSums);
  EXPECT_TRUE(contact.has_force && contact.has_friction && contact.has_depth && state.has_wrench);
}

TEST(ToContacts, TellsWhatWasNotComputed) {
  PairContacts contacts = oneContact();
  contacts.regions[0] = ContactRegion();
  contacts.on_b_in_a = PairContacts().on_b_in_a;
  const PairContactState state =
      toContacts(quarterTurn(), PairStatus(), contacts, Eigen::Isometry3d::Identity());
  const Contact& contact = state.contacts[0];
  EXPECT_EQ(contact.id, 0U) << "no offset is added to no niche";
  EXPECT_FALSE(contact.has_force || contact.has_friction || contact.has_depth || state.has_wrench);
  EXPECT_TRUE(std::isnan(contact.normal_force) && std::isnan(contact.wrench.torque.z) &&
              std::isnan(contact.volume) && std::isnan(state.wrench.force.x));
  EXPECT_TRUE(std::isnan(emptyContacts(quarterTurn(), PairStatus()).wrench_point.x));
}

MarkerStyle contactStyle() {
  MarkerStyle style;
  style.scale = 0.01;
  style.force_scale = 50.0;
  return style;
}

TEST(ContactMarkers, DrawAreaDepthAndForces) {
  const std::vector<Marker> markers = contactMarkers(message(), {false}, contactStyle());
  std::set<std::string> kinds;
  for (const Marker& marker : markers) {
    kinds.insert(marker.ns);
    EXPECT_EQ(marker.id, 7);
    EXPECT_EQ(marker.header.frame_id, "world");
    if (marker.ns == "a/b/contact_area") {
      EXPECT_NEAR(marker.scale.x, 0.02, kSums);
    } else if (marker.ns == "a/b/normal_force") {
      ASSERT_EQ(marker.points.size(), 2U);
      EXPECT_NEAR(marker.points[1].y - marker.points[0].y, 10.0 / 50.0, kSums);
    } else if (marker.ns == "a/b/friction") {
      EXPECT_NEAR(marker.points[1].x - marker.points[0].x, -3.0 / 50.0, kSums);
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"a/b/contact_area", "a/b/contact_depth", "a/b/friction",
                                          "a/b/normal_force"}));
}

TEST(ContactMarkers, DrawNothingThatWasNotComputedAndTellContactsWithoutIdsApart) {
  PairContactState state = message();
  state.body_a = "arm";
  state.body_b = "shelf";
  const auto labelsOf = [&] { return contactLabels({state}, 0, contactStyle().scale); };
  const std::string text = labelsOf().front().text;
  EXPECT_EQ(text.substr(text.find('a')), "arm - shelf: 2.00 mm deep, 10.4 N");
  state.contacts[0].id = 0;
  state.contacts[0].has_force = state.contacts[0].has_friction = state.contacts[0].has_depth = 0;
  state.contacts[0].depth = state.contacts[0].contact_area = kNotComputed;
  state.contacts.push_back(state.contacts[0]);
  EXPECT_TRUE(contactMarkers(state, {false, false}, contactStyle()).empty());
  const std::vector<Marker> labels = labelsOf();
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_NE(labels[0].id, labels[1].id);
  state.contacts[0].centroid.x = kNotComputed;
  EXPECT_EQ(labelsOf().size(), 1U);
}

class EffectsInTheCycle : public ::testing::Test {
 protected:
  EffectsInTheCycle() {
    EffectSettings& effects = scene.pairs.edit(0).settings.effects;
    effects.normal_force.emplace();
    effects.normal_force->model = NormalForceModel::SpringDashpot;
    effects.normal_force->distribution = ForceDistribution::Lumped;
    effects.normal_force->stiffness = 100.0;
    effects.normal_force->damping = 10.0;
    cycle.setScene(scene);
  }
  static ros::Time at(int step) { return ros::Time(100, 0) + ros::Duration(0.01 * step); }
  // b dips into a, deeper by a millimetre a step of 10 ms.
  CycleCounts run(int step, const PairDemand& demand) {
    place(buffer, "a", 0.0, at(step));
    place(buffer, "b", 0.99 - 0.001 * step, at(step));
    place(buffer, "c", -3.0, at(step));
    return cycle.run({demand, kIdle}, at(step));
  }
  static std::uint64_t interferenceRuns(const CycleCounts& report) {
    return report.effects.runs[static_cast<std::size_t>(EffectStage::Interference)];
  }
  const PairContacts* contacts() { return cycle.pairs()[0]->tracked->effects.contacts(); }

  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
  DistanceCycle cycle{buffer, {"world", 1.0, 1}};
};

TEST_F(EffectsInTheCycle, RunWhileSomebodyWantsThemAndWithTheVelocityOfTheTransforms) {
  EXPECT_EQ(interferenceRuns(run(0, kDistance)), 0U);
  EXPECT_EQ(contacts(), nullptr);
  EXPECT_EQ(interferenceRuns(run(1, kContacts)), 1U);
  ASSERT_NE(contacts(), nullptr);
  ASSERT_EQ(contacts()->regions.size(), 1U);
  EXPECT_NEAR(contacts()->regions[0].overlap.depth, 0.011, kSums);
  EXPECT_EQ(contacts()->regions[0].depth_rate, 0.0) << "nothing is known of the motion yet";
  run(2, kContacts);
  EXPECT_NEAR(contacts()->regions[0].depth_rate, 0.1, 1e-6);
  EXPECT_NEAR(contacts()->on_b_in_a.force.x(), 100.0 * 0.012 + 10.0 * 0.1, 1e-6);
  EXPECT_EQ(interferenceRuns(cycle.run({kContacts, kIdle}, at(2))), 0U) << "the last answer is repeated";
  EXPECT_EQ(interferenceRuns(run(3, kDistance)), 0U);
  EXPECT_EQ(contacts(), nullptr);
}

TEST_F(EffectsInTheCycle, ChangeWithTheSettings) {
  run(0, kContacts);
  EXPECT_EQ(
      setEffects(scene, "a/?", "{normal_force: {model: spring_dashpot, stiffness: 200, damping: 0}}").size(),
      2U);
  cycle.setScene(scene);
  EXPECT_EQ(interferenceRuns(cycle.run({kContacts, kIdle}, at(0))), 1U) << "without new transforms";
  EXPECT_NEAR(contacts()->on_b_in_a.force.x(), 200.0 * 0.01, kSums);
  setEffects(scene, "*", "none");
  cycle.setScene(scene);
  EXPECT_EQ(interferenceRuns(run(1, kContacts)), 0U);
  EXPECT_EQ(contacts(), nullptr);
  EXPECT_THROW(setEffects(scene, "a/d", "none"), Error);
  scene.pairs.edit(0).settings.tracker.accuracy = AccuracyLevel::Refined;
  EXPECT_THROW(setEffects(scene, "a/b", "{interference: true}"), Error) << "without a proof";
}

TEST(DescribeEffects, TellsRunsAndShares) {
  CycleWindow window;
  diagnostic_updater::DiagnosticStatusWrapper status;
  describeEffects(window, status);
  EXPECT_EQ(status.values.size(), kEffectStages) << "runs, all of them 0";
  window.total.effects.runs[0] = 5;
  window.total.effects.seconds[0] = 0.01;
  window.cpu.add(0.04);
  diagnostic_updater::DiagnosticStatusWrapper busy;
  describeEffects(window, busy);
  EXPECT_EQ(busy.values[1].value, "25.0");
}

}  // namespace
}  // namespace concave_distance::contacts_test
