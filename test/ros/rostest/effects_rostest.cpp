// Effects of a running node: contacts on topics, as markers and in services, only while somebody listens;
// switched on and off, and refused.
#include <concave_distance/Contacts.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/Niches.h>
#include <concave_distance/SetEffects.h>
#include <gtest/gtest.h>
#include <ros/package.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "node_access.h"
#include "run_node.h"
#include "tf_player.h"

namespace concave_distance::effects_rostest {
namespace {

// Metres that the block is pressed into the crate's face, its side and the spring's stiffness in N/m.
constexpr double kPressed = 0.02;
constexpr double kSide = 0.2;
constexpr double kStiffness = 1000.0;
// Bounds the rounding of values of order 1 and below after exact predicates and some sums.
constexpr double kSums = 1e-9;

class EffectsTest : public ::testing::Test {
 protected:
  EffectsTest() {
    player.place("crate", 0.0);
    player.place("other", 0.0, 5.0);
    press(kPressed);
  }
  ~EffectsTest() override { EXPECT_TRUE(set("plain", "none").success); }

  // The block's middle stands at a tenth beside the middle of the crate's face.
  void press(double depth) { player.place("block", 0.5 + 0.5 * kSide - depth, 0.1); }
  void part() { player.place("block", 1.0, 0.1); }
  static SetEffectsResponse set(const std::string& pair, const std::string& effects) {
    SetEffectsRequest request;
    request.pair = pair;
    request.effects = effects;
    return call<SetEffects>(kNode + "set_effects", request);
  }

  TfPlayer player;
};

bool hasContact(const PairContactState& state) {
  return state.contacts.size() == 1;
}

TEST_F(EffectsTest, ContactsHaveTheValuesOfClosedForms) {
  Collector<PairContactState> own(kNode + "pairs/press/contacts");
  Collector<Contacts> all(kNode + "contacts");
  ASSERT_TRUE(own.waitFor([](const PairContactState& m) { return hasContact(m) && m.contacts[0].id != 0; }));
  // Nothing moves any more: rates are 0.
  ASSERT_TRUE(own.waitFor([](const PairContactState& m) {
    return hasContact(m) && std::abs(m.contacts[0].normal_force - kStiffness * kPressed) < kSums;
  }));
  const PairContactState state = *own.last();
  EXPECT_EQ(state.header.frame_id, "world");
  EXPECT_EQ(state.status.code, PairStatus::PENETRATING);
  EXPECT_TRUE(state.possible);
  const Contact contact = state.contacts[0];
  EXPECT_NEAR(contact.depth, kPressed, kSums);
  EXPECT_NEAR(contact.contact_area, kSide * kSide, kSums);
  EXPECT_NEAR(contact.surface_area_a, kSide * kSide, kSums);
  EXPECT_NEAR(contact.surface_area_b, kSide * kSide + 4.0 * kSide * kPressed, kSums);
  EXPECT_NEAR(contact.volume, kSide * kSide * kPressed, kSums);
  EXPECT_NEAR(contact.centroid.x, 0.5 - 0.5 * kPressed, kSums);
  EXPECT_NEAR(contact.centroid.y, 0.1, kSums);
  EXPECT_NEAR(contact.normal.x, 1.0, kSums);
  EXPECT_NEAR(contact.depth_rate, 0.0, kSums);
  EXPECT_TRUE(contact.closed && contact.has_depth && contact.has_force && contact.has_friction);
  ASSERT_TRUE(state.has_wrench);
  EXPECT_NEAR(state.wrench.force.x, kStiffness * kPressed, kSums);
  EXPECT_NEAR(state.wrench.force.z, 0.0, kSums);
  EXPECT_NEAR(state.wrench_point.x, 0.5 + 0.5 * kSide - kPressed, kSums);
  EXPECT_NEAR(state.wrench.torque.z, 0.0, kSums) << "the force goes through the block's middle";

  ASSERT_TRUE(all.waitFor([](const Contacts& m) { return m.pairs.size() == 1 && hasContact(m.pairs[0]); }))
      << "the pair that asks for effects, and no other";
  EXPECT_EQ(all.last()->pairs[0].pair, "press");
  Collector<PairNiches> niches(kNode + "pairs/press/niches");
  ASSERT_TRUE(niches.waitFor([](const PairNiches& m) { return !m.niches.empty(); }));
  const auto known = niches.last()->niches;
  EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const Niche& n) { return n.id == contact.id; }))
      << "a contact has its niche's id";

  part();
  ASSERT_TRUE(own.waitFor([](const PairContactState& m) { return !m.possible; }));
  EXPECT_TRUE(own.last()->contacts.empty());
  EXPECT_TRUE(own.last()->has_wrench) << "apart is known: no force";
  EXPECT_EQ(own.last()->wrench.force.x, 0.0);
}

TEST_F(EffectsTest, NothingIsComputedThatNobodySubscribesTo) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Collector<Distances> distances(kNode + "distances");
  // The figures are those of a whole window in which pairs were solved.
  const auto runs = [&](const std::string& stage, bool some) {
    diagnostics.clear();
    return eventually([&] {
      const auto seen = diagnostics.all();
      return seen.size() > 2 && counted(seen.back(), "solves") > 5 &&
             (counted(seen.back(), stage + " runs") > 0) == some;
    });
  };
  EXPECT_TRUE(runs("interference", false));
  {
    Collector<PairContactState> contacts(kNode + "pairs/press/contacts");
    EXPECT_TRUE(runs("interference", true));
    EXPECT_TRUE(runs("normal_force", true));
    EXPECT_GT(counted(*diagnostics.last(), "interference share of the processor time (%)"), 0.0);
    part();
    EXPECT_TRUE(runs("interference", false)) << "the proof excludes contact";
    press(kPressed);
    EXPECT_TRUE(runs("interference", true));
  }
  EXPECT_TRUE(runs("interference", false)) << "unsubscribing ends it";
}

TEST_F(EffectsTest, EffectsAreSwitchedOnAndOffWhileRunning) {
  player.place("other", 0.5 + 0.5 * kSide - kPressed, -0.2);
  Collector<Contacts> all(kNode + "contacts");
  const auto state = [&](const std::string& pair) {
    const auto message = all.last();
    if (message) {
      for (const PairContactState& one : message->pairs) {
        if (one.pair == pair && hasContact(one)) return one;
      }
    }
    return PairContactState();
  };
  ASSERT_TRUE(eventually([&] { return state("press").pair == "press"; }));
  EXPECT_EQ(all.last()->pairs.size(), 1U);

  const auto on = set("pl*", "{interference: true}");
  ASSERT_TRUE(on.success) << on.message;
  EXPECT_EQ(on.pairs, std::vector<std::string>{"plain"});
  ASSERT_TRUE(eventually([&] { return state("plain").pair == "plain"; }));
  EXPECT_FALSE(state("plain").contacts[0].has_force);
  EXPECT_TRUE(std::isnan(state("plain").contacts[0].normal_force)) << "not asked for";
  EXPECT_FALSE(state("plain").has_wrench);
  EXPECT_NEAR(state("plain").contacts[0].depth, kPressed, kSums);

  ASSERT_TRUE(set("plain", "{normal_force: hertz}").success);
  EXPECT_TRUE(
      eventually([&] { return state("plain").has_wrench && state("plain").contacts[0].normal_force > 0.0; }));
  EXPECT_FALSE(state("plain").contacts[0].has_friction);

  ASSERT_TRUE(set("*", "none").success);
  EXPECT_TRUE(eventually([&] { return all.last()->pairs.empty(); }));
  ASSERT_TRUE(set("press",
                  "{normal_force: {model: spring_dashpot, distribution: lumped, stiffness: 1000}, friction: "
                  "regularised_coulomb}")
                  .success);
  EXPECT_TRUE(eventually([&] { return state("press").has_wrench != 0; }));
}

TEST_F(EffectsTest, WrongEffectsAreRefusedWithTheKeyAndWhatIsAllowed) {
  const auto expect_refusal = [](const std::string& pair, const std::string& effects,
                                 const std::vector<std::string>& parts) {
    const auto response = set(pair, effects);
    EXPECT_FALSE(response.success) << effects;
    EXPECT_TRUE(response.pairs.empty()) << effects;
    for (const std::string& part : parts) {
      EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
    }
  };
  expect_refusal("plain", "{normal_force: springy}", {"normal_force", "springy", "hunt_crossley"});
  expect_refusal("plain", "{normal_farce: hertz}", {"normal_farce", "normal_force"});
  expect_refusal("plain", "{normal_force: {model: spring_dashpot, stiffness: -1}}",
                 {"stiffness", "-1", "greater than 0"});
  expect_refusal("plain", "{friction: bristle}", {"friction", "normal_force"});
  expect_refusal("plain", "", {"none"});
  expect_refusal("plain", "{interference: [", {"effects"});
  expect_refusal("nobody", "none", {"nobody", "list_bodies"});
  Collector<Contacts> all(kNode + "contacts");
  EXPECT_TRUE(all.waitFor([](const Contacts& m) { return m.pairs.size() == 1; })) << "nothing was changed";
}

TEST_F(EffectsTest, WrongEffectsAndMaterialsEndTheNode) {
  const std::string folder = ros::package::getPath("concave_distance") + "/test/ros/rostest/";
  const auto expect_end = [&](const std::string& file, const std::vector<std::string>& parts) {
    const Ended ended = runNode("__name:=wrong _robot_description:='' _scene_file:=" + folder + file);
    EXPECT_EQ(ended.exit_code, 1);
    for (const std::string& part : parts) {
      EXPECT_NE(ended.output.find(part), std::string::npos) << ended.output;
    }
  };
  expect_end("broken_effects.yaml", {"broken_effects.yaml:4", "normal_force", "springy", "hunt_crossley"});
  expect_end("broken_material.yaml", {"broken_material.yaml:3", "poissons_ratio", "0.7", "below 0.5"});
}

TEST_F(EffectsTest, ContactMarkersComeAndGoWithTheContact) {
  using visualization_msgs::Marker;
  using visualization_msgs::MarkerArray;
  Collector<MarkerArray> markers(kNode + "markers");
  const auto last = [&](const std::string& ns, int action) {
    return markers.waitFor([&](const MarkerArray& message) {
      return std::any_of(message.markers.begin(), message.markers.end(), [&](const Marker& marker) {
        return marker.ns == "press/" + ns && marker.action == action;
      });
    });
  };
  const auto ever = [&](const std::string& ns, int action) {
    return eventually([&] {
      const auto messages = markers.all();
      return std::any_of(messages.begin(), messages.end(), [&](const MarkerArray& message) {
        return std::any_of(message.markers.begin(), message.markers.end(), [&](const Marker& marker) {
          return marker.ns == "press/" + ns && marker.action == action;
        });
      });
    });
  };
  for (const char* ns : {"contact_area", "contact_depth", "normal_force", "contact_text"}) {
    EXPECT_TRUE(last(ns, Marker::ADD)) << ns;
  }
  const MarkerArray drawn = *markers.last();
  for (const Marker& marker : drawn.markers) {
    if (marker.ns != "press/normal_force") continue;
    ASSERT_EQ(marker.points.size(), 2U);
    EXPECT_NEAR(marker.points[1].x - marker.points[0].x, kStiffness * kPressed / 200.0, 1e-6)
        << "200 N a metre, as ~force_marker_scale says";
  }
  markers.clear();
  part();
  for (const char* ns : {"contact_area", "contact_depth", "normal_force", "contact_text"}) {
    EXPECT_TRUE(ever(ns, Marker::DELETE)) << ns;
  }
}

TEST_F(EffectsTest, ThePressureIsDrawnWhereAPairHasOne) {
  using visualization_msgs::MarkerArray;
  player.place("other", 0.5 + 0.5 * kSide - kPressed, -0.2);
  ASSERT_TRUE(set("plain", "{normal_force: {model: elastic_foundation, foundation_stiffness: 1e6}}").success);
  Collector<MarkerArray> markers(kNode + "markers");
  EXPECT_TRUE(markers.waitFor([](const MarkerArray& message) {
    return std::any_of(message.markers.begin(), message.markers.end(), [](const auto& marker) {
      return marker.ns == "plain/pressure" && marker.points.size() > 300 &&
             marker.colors.size() == marker.points.size();
    });
  }));
}

TEST_F(EffectsTest, QueriesFindContactsWhateverThePairAsksFor) {
  GetDistanceRequest request;
  request.query.body_a = "crate";
  request.query.body_b = "other";
  request.query.use_pose_b = 1;
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  request.query.pose_b.header.frame_id = "crate";
  request.query.pose_b.pose.position.x = 0.5 + 0.5 * kSide - kPressed;
  ASSERT_TRUE(eventually([&] { return call<GetDistance>(kNode + "get_distance", request).success; }));
  EXPECT_EQ(call<GetDistance>(kNode + "get_distance", request).contacts.pair, "") << "not asked for";
  request.query.with_contacts = 1;
  const auto answer = call<GetDistance>(kNode + "get_distance", request);
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_EQ(answer.contacts.contacts.size(), 1U);
  EXPECT_EQ(answer.contacts.contacts[0].id, 0U);
  EXPECT_NEAR(answer.contacts.contacts[0].volume, kSide * kSide * kPressed, kSums);
  EXPECT_FALSE(answer.contacts.has_wrench);
  request.query.accuracy = DistanceQuery::ACCURACY_REFINED;
  const auto refused = call<GetDistance>(kNode + "get_distance", request);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("with_contacts"), std::string::npos) << refused.message;
}

}  // namespace
}  // namespace concave_distance::effects_rostest
