// Topics of a running node: contents, who gets what, dropouts of tf, alerts, markers, reconfiguration.
#include <concave_distance/AddBody.h>
#include <concave_distance/Alert.h>
#include <concave_distance/Distances.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/Nearest.h>
#include <concave_distance/Niches.h>
#include <concave_distance/PairNiches.h>
#include <concave_distance/RemoveBody.h>
#include <concave_distance/SetPairEnabled.h>
#include <gtest/gtest.h>
#include <ros/master.h>
#include <ros/package.h>
#include <std_msgs/Float64.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "node_access.h"
#include "started_node.h"
#include "tf_player.h"

namespace concave_distance::topics_rostest {
namespace {

// A period in which cycles did nothing but look who listens.
bool isIdle(const diagnostic_msgs::DiagnosticArray& message) {
  return counted(message, "solves") == 0 && counted(message, "pairs watched") == 0 &&
         counted(message, "pairs turned into messages") == 0 && counted(message, "markers built") == 0;
}

const PairDistance* find(const Distances& distances, const std::string& pair) {
  for (const PairDistance& distance : distances.pairs) {
    if (distance.pair == pair) {
      return &distance;
    }
  }
  return nullptr;
}

// Leaves out messages without an answer: a machine that stalls makes all transforms old for a moment.
std::vector<PairNiches> solved(const std::vector<PairNiches>& messages) {
  std::vector<PairNiches> answers;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(answers),
               [](const PairNiches& message) { return message.nearest.has_distance != 0; });
  return answers;
}

class TopicsTest : public ::testing::Test {
 protected:
  TopicsTest() {
    player.place("box_a", 0.0);
    player.place("box_b", 2.0);
    player.place("ball", 0.0, 3.0);
  }
  TfPlayer player;
};

TEST_F(TopicsTest, NothingIsComputedWithoutSubscribers) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(diagnostics.waitFor([](const auto& message) {
    return counted(message, "cycles") > 0 && isIdle(message);
  })) << "cycles run, nothing is solved, no message and no marker built";
  {
    Collector<PairDistance> one(kNode + "pairs/boxes/distance");
    EXPECT_TRUE(diagnostics.waitFor([](const auto& message) {
      return counted(message, "pairs watched") == 1 && counted(message, "solves") > 0 &&
             counted(message, "pairs turned into messages") == counted(message, "cycles") &&
             counted(message, "markers built") == 0;
    })) << "the pair subscribed to and no other, and no marker";
  }
  EXPECT_TRUE(diagnostics.waitFor(isIdle)) << "the last subscriber has gone";
}

TEST_F(TopicsTest, MarkersAloneMakeTheNodeSolveAtTheirRateOnly) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Collector<visualization_msgs::MarkerArray> markers(kNode + "markers");
  // Every fifth cycle has markers, however many there are in a period.
  EXPECT_TRUE(diagnostics.match([](const auto& message) {
    const double cycles = counted(message, "cycles");
    const double of_each_pair = counted(message, "pairs turned into messages") / 2.0;
    return cycles >= 10 && std::abs(of_each_pair - 0.2 * cycles) <= 1.0 &&
           counted(message, "markers built") > 0;
  })) << "pairs turned into messages: "
      << (diagnostics.last() ? diagnosed(*diagnostics.last(), "pairs turned into messages") : "none");
}

TEST_F(TopicsTest, NearestIsThePairAndTheNumberAndFallsSilentWithoutTransforms) {
  Collector<Nearest> nearest(kNode + "nearest");
  Collector<std_msgs::Float64> number(kNode + "nearest_distance");
  ASSERT_TRUE(nearest.waitFor([](const Nearest& message) { return message.pair == "boxes"; }));
  const Nearest message = *nearest.last();
  EXPECT_NEAR(message.distance, 1.0, kRounding);
  EXPECT_EQ(message.pairs, 3U);
  EXPECT_EQ(message.pairs_beyond_cutoff, 1U) << "ball_blocks";
  EXPECT_TRUE(message.is_minimum) << message.message;
  ASSERT_TRUE(number.waitFor([&](const auto& value) { return value.data == message.number; }));
  player.drop("ball");
  ASSERT_TRUE(nearest.waitFor([](const Nearest& later) { return later.pairs_missing == 2; }));
  EXPECT_FALSE(nearest.last()->has_number);
  EXPECT_NE(nearest.last()->message.find("2 of 3 pairs"), std::string::npos) << nearest.last()->message;
  // Messages that were on their way have come: ten more cycles bring no number.
  const std::size_t later = nearest.count() + 10;
  number.clear();
  ASSERT_TRUE(eventually([&] { return nearest.count() > later; }));
  number.clear();
  ASSERT_TRUE(eventually([&] { return nearest.count() > later + 10; }));
  EXPECT_EQ(number.count(), 0U);
  player.place("ball", 0.0, 3.0);
  EXPECT_TRUE(eventually([&] { return number.count() > 0; }));
}

TEST(PairTopics, PairsHaveTopicsOnlyWhereAPatternNamesThem) {
  const std::string scene = ros::package::getPath("concave_distance") + "/test/ros/rostest/boxes.yaml";
  const StartedNode chosen({"__name:=chosen", "_scene_file:=" + scene, "_pair_topics:=box*"});
  ASSERT_TRUE(eventually([] { return call<ListBodies>("/chosen/list_bodies", {}).ready != 0; }));
  const auto topics = [] {
    ros::master::V_TopicInfo all;
    ros::master::getTopics(all);
    std::set<std::string> names;
    for (const auto& topic : all) {
      if (topic.name.rfind("/chosen/pairs/", 0) == 0) {
        names.insert(topic.name);
      }
    }
    return names;
  };
  ASSERT_TRUE(eventually([&] { return topics().size() >= 6; }));
  EXPECT_EQ(topics(),
            (std::set<std::string>{"/chosen/pairs/boxes/distance", "/chosen/pairs/boxes/niches",
                                   "/chosen/pairs/boxes/contacts", "/chosen/pairs/box_ball/distance",
                                   "/chosen/pairs/box_ball/niches", "/chosen/pairs/box_ball/contacts"}));
}

// The distance of a pair names its nearest niche while niches are computed.
TEST_F(TopicsTest, MarkersAskForNichesOfNoPairButThoseTheyDraw) {
  const std::string scene = ros::package::getPath("concave_distance") + "/test/ros/rostest/boxes.yaml";
  const StartedNode drawing({"__name:=drawing", "_scene_file:=" + scene, "_marker_pair_count:=1"});
  Collector<Distances> distances("/drawing/distances");
  Collector<visualization_msgs::MarkerArray> markers("/drawing/markers");
  const auto with_niches = [](const Distances& message) {
    std::set<std::string> pairs;
    for (const PairDistance& pair : message.pairs) {
      if (pair.nearest_niche_id != 0) pairs.insert(pair.pair);
    }
    return pairs;
  };
  const auto draws = [](const std::string& ns) {
    return [ns](const visualization_msgs::MarkerArray& message) {
      return std::any_of(message.markers.begin(), message.markers.end(), [&](const auto& marker) {
        return marker.ns == ns && marker.action == visualization_msgs::Marker::ADD;
      });
    };
  };
  ASSERT_TRUE(markers.waitFor(draws("boxes/line")));
  for (const Distances& message : distances.all()) {
    EXPECT_EQ(with_niches(message).count("box_ball"), 0U) << "only the nearest pair is drawn";
  }
  player.place("ball", 0.0, 1.5);  // nearer than the boxes
  ASSERT_TRUE(markers.waitFor(draws("box_ball/line")));
  EXPECT_TRUE(distances.waitFor([&](const Distances& message) {
    return with_niches(message) == std::set<std::string>{"box_ball"};
  })) << "the other one is let go";
}

TEST_F(TopicsTest, DistancesCarryEveryPairAtTheTimeOfItsTransforms) {
  const ros::Time start = ros::Time::now();
  Collector<Distances> distances(kNode + "distances");
  const auto message = distances.match([&](const Distances& each) {
    const auto is_fresh = [&](const PairDistance* pair) {
      return pair != nullptr && pair->has_distance != 0 && pair->header.stamp > start;
    };
    return is_fresh(find(each, "boxes")) && is_fresh(find(each, "box_ball"));
  });
  ASSERT_TRUE(message);
  ASSERT_EQ(message->pairs.size(), 2U) << "ball_blocks is beyond its cutoff";
  EXPECT_EQ(message->pairs_beyond_cutoff, 1U);
  EXPECT_TRUE(message->has_others_lower_bound);
  EXPECT_GT(message->others_lower_bound, 2.0);
  EXPECT_EQ(message->pairs_missing, 0U);
  EXPECT_EQ(message->pairs_cut, 0U);
  const PairDistance boxes = *find(*message, "boxes");
  EXPECT_NEAR(boxes.distance, 1.0, kRounding);
  EXPECT_EQ(boxes.header.frame_id, "world");
  EXPECT_LE(message->header.stamp, boxes.header.stamp);
  EXPECT_LE(boxes.header.stamp, ros::Time::now());
  EXPECT_NEAR(boxes.point_b.x - boxes.point_a.x, 1.0, kRounding);
  EXPECT_EQ(boxes.nearest_niche_id, 0U) << "nobody asked for niches";
}

TEST_F(TopicsTest, DistanceFollowsTheMotionAndTellsTheClosingSpeed) {
  Collector<PairDistance> distance(kNode + "pairs/boxes/distance");
  ASSERT_TRUE(distance.match([](const PairDistance& message) {
    return message.has_closing_speed != 0 && std::abs(message.distance - 1.0) < kRounding &&
           std::abs(message.closing_speed) < 1e-9;
  })) << "at rest";
  player.glide("box_b", 2.0, 1.4, 3.0);
  EXPECT_TRUE(distance.match([](const PairDistance& message) {
    return message.has_closing_speed != 0 && std::abs(message.closing_speed - 0.2) < 1e-4;
  })) << "the speed at which it was moved";
  EXPECT_TRUE(
      distance.waitFor([](const PairDistance& message) { return std::abs(message.distance - 0.4) < 1e-9; }));
}

TEST_F(TopicsTest, NichesKeepTheirIdsFromCycleToCycle) {
  Collector<PairNiches> niches(kNode + "pairs/boxes/niches");
  ASSERT_TRUE(niches.waitFor([](const PairNiches& message) {
    return message.nearest.has_distance && std::abs(message.nearest.distance - 1.0) < kRounding;
  }));
  niches.clear();
  std::vector<PairNiches> all;
  ASSERT_TRUE(eventually([&] {
    all = solved(niches.all());
    return all.size() > 20;
  }));
  const std::uint64_t id = all.back().nearest.nearest_niche_id;
  EXPECT_NE(id, 0U);
  for (const PairNiches& message : all) {
    ASSERT_FALSE(message.niches.empty());
    EXPECT_EQ(message.niches[0].id, id);
    EXPECT_EQ(message.niches[0].kind, Niche::KIND_PATCH) << "parallel faces";
    EXPECT_NEAR(message.niches[0].distance, 1.0, kRounding);
  }
}

// The ball passes over two blocks, from one to the other and back: the distance to the one shrinks while that
// to the other grows, and they cross in the middle.
TEST_F(TopicsTest, NichesThatStayApartKeepTheirIdsWhileTheirDistancesCross) {
  const auto is_over = [](double x) {
    return [x](const PairNiches& message) {
      return message.niches.size() == 2 &&
             std::abs(message.niches[0].point_b.x - std::copysign(0.75, x)) < 0.3;
    };
  };
  player.place("ball", -0.6, 3.0, 11.0);
  // A message of the pose before would leave the births of the jump to the messages that are compared, and
  // what was there before may end in a cycle of its own.
  const ros::Time at_start = ros::Time::now();
  Collector<PairNiches> niches(kNode + "pairs/ball_blocks/niches");
  ASSERT_TRUE(niches.waitFor([&](const PairNiches& message) {
    return is_over(-1.0)(message) && message.header.stamp > at_start && message.changes.empty();
  }));
  niches.clear();
  for (int step = -60; step <= 180; ++step) {
    const double x = step <= 60 ? 0.01 * step : 0.01 * (120 - step);
    player.place("ball", x, 3.0, 11.0);
    // Step by step: a node that does not get to run for a while would see one large jump.
    const ros::Time placed = ros::Time::now();
    ASSERT_TRUE(niches.waitFor([&](const PairNiches& message) {
      return message.nearest.has_distance != 0 && message.header.stamp > placed;
    }));
  }
  ASSERT_TRUE(niches.waitFor(is_over(-1.0)));
  const std::vector<PairNiches> all = solved(niches.all());
  std::map<bool, std::set<std::uint64_t>> ids_of_side;  // of the block on the right: true
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].niches.size(), 2U) << "one niche a block";
    EXPECT_TRUE(all[i].changes.empty())
        << "no birth, no death, no merger in message " << i << " of " << all.size();
    for (const Niche& niche : all[i].niches) {
      ids_of_side[niche.point_b.x > 0.0].insert(niche.id);
    }
    crossings += i > 0 && all[i].nearest.nearest_niche_id != all[i - 1].nearest.nearest_niche_id ? 1 : 0;
  }
  EXPECT_EQ(ids_of_side[false].size(), 1U) << "one id on the left";
  EXPECT_EQ(ids_of_side[true].size(), 1U) << "one on the right";
  EXPECT_NE(ids_of_side[false], ids_of_side[true]);
  EXPECT_EQ(crossings, 2U) << "the nearest is the other one, there and back";
}

TEST_F(TopicsTest, APairWithoutTransformsSaysSoAndTheOthersGoOn) {
  Collector<Distances> distances(kNode + "distances");
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const auto status_of = [&](const std::string& pair, std::uint8_t code) {
    return distances.waitFor([&](const Distances& message) {
      const PairDistance* distance = find(message, pair);
      return distance != nullptr && distance->status.code == code;
    });
  };
  ASSERT_TRUE(status_of("box_ball", PairStatus::OK));
  player.drop("ball");
  ASSERT_TRUE(status_of("box_ball", PairStatus::STALE_TRANSFORM)) << "after ~stale_after";
  const Distances message = *distances.last();
  EXPECT_FALSE(find(message, "box_ball")->has_distance);
  EXPECT_TRUE(std::isnan(find(message, "box_ball")->distance));
  // In one message: a machine that stalls makes all transforms old for a moment.
  EXPECT_TRUE(distances.waitFor([](const Distances& each) {
    return find(each, "box_ball")->status.code == PairStatus::STALE_TRANSFORM &&
           find(each, "boxes")->status.code == PairStatus::OK;
  }));
  EXPECT_TRUE(diagnostics.waitFor(
      [](const auto& array) { return diagnosed(array, "pairs without transforms") == "2"; }));
  player.place("ball", 0.0, 3.0);
  EXPECT_TRUE(status_of("box_ball", PairStatus::OK)) << "it comes back by itself";
}

TEST_F(TopicsTest, AlertsRiseAndClearWithHysteresis) {
  Collector<Alert> alerts(kNode + "alerts");
  player.place("box_b", 1.4);
  const auto raised = alerts.match([](const Alert& alert) { return alert.state == Alert::WARNING; });
  ASSERT_TRUE(raised);
  EXPECT_EQ(raised->nearest.pair, "boxes");
  EXPECT_TRUE(raised->nearest.warning);
  alerts.clear();
  Collector<PairDistance> distance(kNode + "pairs/boxes/distance");
  player.place("box_b", 1.6);
  const auto inside = distance.match([](const PairDistance& message) { return message.distance > 0.55; });
  ASSERT_TRUE(inside);
  EXPECT_TRUE(inside->warning) << "0.6 is inside 0.5 + 0.2";
  player.place("box_b", 1.8);
  const auto cleared = alerts.match([](const Alert& alert) { return alert.state == Alert::CLEAR; });
  ASSERT_TRUE(cleared);
  EXPECT_GT(cleared->nearest.distance, 0.7) << "not at 0.6";
  player.drop("box_b");
  const auto unknown = alerts.match([](const Alert& alert) { return alert.state == Alert::UNKNOWN; });
  ASSERT_TRUE(unknown) << "a pair that cannot be watched is reported";
  EXPECT_EQ(unknown->nearest.status.code, PairStatus::STALE_TRANSFORM);
}

TEST_F(TopicsTest, AlertsThatStandAreRepeatedForANewSubscriber) {
  Collector<PairDistance> distance(kNode + "pairs/boxes/distance");
  player.place("box_b", 1.4);
  ASSERT_TRUE(distance.waitFor([](const PairDistance& message) { return message.warning != 0; }))
      << "raised while nobody listened to the alerts";
  Collector<Alert> newcomer(kNode + "alerts");
  EXPECT_TRUE(newcomer.waitFor([](const Alert& alert) { return alert.state == Alert::WARNING; }));
}

TEST_F(TopicsTest, APairSwitchedOffTakesItsAlertBack) {
  Collector<Alert> alerts(kNode + "alerts");
  player.place("box_b", 1.2);
  ASSERT_TRUE(alerts.waitFor([](const Alert& alert) { return alert.state == Alert::WARNING; }));
  SetPairEnabledRequest request;
  request.pair = "boxes";
  call<SetPairEnabled>(kNode + "set_pair_enabled", request);
  EXPECT_TRUE(alerts.waitFor([](const Alert& alert) {
    return alert.state == Alert::CLEAR && alert.nearest.status.code == PairStatus::DISABLED;
  }));
  request.enabled = 1;
  call<SetPairEnabled>(kNode + "set_pair_enabled", request);
  EXPECT_TRUE(alerts.waitFor([](const Alert& alert) { return alert.state == Alert::WARNING; }));
}

TEST_F(TopicsTest, MarkersShowEveryNicheAndDeleteWhatVanished) {
  Collector<visualization_msgs::MarkerArray> markers(kNode + "markers");
  Collector<Niches> niches(kNode + "niches");
  const auto shows = [](const visualization_msgs::MarkerArray& message, const std::string& ns, int action) {
    return std::any_of(message.markers.begin(), message.markers.end(),
                       [&](const auto& marker) { return marker.ns == ns && marker.action == action; });
  };
  using visualization_msgs::Marker;
  for (const char* ns : {"boxes/points", "boxes/line", "boxes/text", "box_ball/line"}) {
    EXPECT_TRUE(markers.waitFor([&](const auto& message) { return shows(message, ns, Marker::ADD); })) << ns;
  }
  // Until niches are known, a pair's shortest distance is drawn under id 0.
  ASSERT_TRUE(markers.waitFor([](const auto& drawn) {
    return std::any_of(drawn.markers.begin(), drawn.markers.end(),
                       [](const Marker& marker) { return marker.ns == "boxes/line" && marker.id != 0; });
  }));
  const auto message = *markers.last();
  for (const Marker& marker : message.markers) {
    // The tint of a body moves with it.
    if (marker.ns != "warning") {
      EXPECT_EQ(marker.header.frame_id, "world");
    }
    if (marker.action == Marker::ADD) {
      EXPECT_GT(marker.lifetime.toSec(), 0.0);
    }
  }
  std::set<std::pair<std::string, std::uint64_t>> known;
  ASSERT_TRUE(niches.waitFor([](const Niches& list) { return !list.pairs.empty(); }));
  for (const Niches& list : niches.all()) {
    for (const PairNiches& pair : list.pairs) {
      for (const Niche& niche : pair.niches) {
        known.emplace(pair.nearest.pair + "/line", niche.id);
      }
    }
  }
  for (const Marker& marker : message.markers) {
    if (marker.ns == "boxes/line" && marker.action == Marker::ADD) {
      EXPECT_EQ(known.count({marker.ns, static_cast<std::uint64_t>(marker.id)}), 1U) << marker.id;
    }
  }
  SetPairEnabledRequest request;
  request.pair = "boxes";
  call<SetPairEnabled>(kNode + "set_pair_enabled", request);
  EXPECT_TRUE(eventually([&] {
    for (const auto& array : markers.all()) {
      if (shows(array, "boxes/line", Marker::DELETE)) {
        return true;
      }
    }
    return false;
  })) << "the pair is gone from the screen";
  request.enabled = 1;
  call<SetPairEnabled>(kNode + "set_pair_enabled", request);
}

TEST_F(TopicsTest, MarkersOfANicheThatVanishesAreDeleted) {
  using visualization_msgs::Marker;
  const std::string line = "ball_blocks/line";
  Collector<visualization_msgs::MarkerArray> markers(kNode + "markers");
  const auto ids_with = [&](const visualization_msgs::MarkerArray& message, int action) {
    std::set<int> ids;
    for (const Marker& marker : message.markers) {
      if (marker.ns == line && marker.action == action) {
        ids.insert(marker.id);
      }
    }
    return ids;
  };
  player.place("ball", 0.0, 3.0, 11.0);
  const auto two =
      markers.match([&](const auto& message) { return ids_with(message, Marker::ADD).size() == 2; });
  ASSERT_TRUE(two) << "one niche a block";
  const std::set<int> both = ids_with(*two, Marker::ADD);
  markers.clear();
  player.place("ball", 2.0, 3.0, 11.0);  // one block is 2.3 m away now, beyond the pair's cutoff
  const auto one =
      markers.match([&](const auto& message) { return ids_with(message, Marker::ADD).size() == 1; });
  ASSERT_TRUE(one);
  const int kept = *ids_with(*one, Marker::ADD).begin();
  EXPECT_EQ(both.count(kept), 1U) << "the niche that stays keeps its id";
  std::set<int> deleted;
  for (const auto& message : markers.all()) {
    deleted.merge(ids_with(message, Marker::DELETE));
  }
  std::set<int> gone = both;
  gone.erase(kept);
  EXPECT_EQ(deleted, gone);
}

TEST_F(TopicsTest, BodyMarkersComeOnceWithEveryBody) {
  Collector<visualization_msgs::MarkerArray> bodies(kNode + "body_markers");
  ASSERT_TRUE(bodies.waitFor([](const auto& message) { return message.markers.size() == 5; }))
      << "a DELETEALL and four bodies";
  EXPECT_EQ(bodies.last()->markers[1].points.size(), 36U);
}

TEST_F(TopicsTest, ReconfigurationTakesEffectWhileRunning) {
  Collector<PairDistance> distance(kNode + "pairs/boxes/distance");
  ASSERT_TRUE(distance.waitFor([](const PairDistance& message) { return message.has_distance != 0; }));
  reconfigure("cutoff", "0.8");
  EXPECT_TRUE(distance.waitFor(
      [](const PairDistance& message) { return message.status.code == PairStatus::BEYOND_CUTOFF; }));
  EXPECT_TRUE(distance.last()->has_lower_bound);
  EXPECT_GT(distance.last()->lower_bound, 0.8);
  EXPECT_LE(distance.last()->lower_bound, 1.0);
  reconfigure("cutoff", "none");
  EXPECT_TRUE(distance.waitFor([](const PairDistance& message) { return message.has_distance != 0; }));
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  reconfigure("rate", 20.0);
  EXPECT_TRUE(diagnostics.match([](const auto& array) {
    return counted(array, "rate wanted (Hz)") == 20.0 && counted(array, "cycles") > 1 &&
           counted(array, "rate achieved (Hz)") < 22.0;
  })) << "no faster than that, however busy the machine is";
  reconfigure("rate", 100.0);
}

TEST_F(TopicsTest, AReconfigurationOutOfRangeChangesNothingAndTheAnswerSaysSo) {
  const auto cutoff_of = [](const dynamic_reconfigure::Config& config) {
    for (const auto& value : config.strs) {
      if (value.name == "cutoff") return value.value;
    }
    return std::string();
  };
  EXPECT_EQ(cutoff_of(reconfigure("cutoff", "5")), "5");
  for (const std::string value : {"-1", "0", "nan", "inf", "far", ""}) {
    EXPECT_EQ(cutoff_of(reconfigure("cutoff", value)), "5") << value;
  }
  EXPECT_EQ(cutoff_of(reconfigure("rate", -1.0)), "5");
  EXPECT_EQ(cutoff_of(reconfigure("cutoff", "none")), "none");
}

TEST_F(TopicsTest, ABodyAddedDuringAReconfigurationGetsItsSettings) {
  std::future<AddBody> adding = std::async(std::launch::async, [] {
    AddBody service;
    service.request.name = "late";
    service.request.frame_id = "late";
    service.request.primitive = "sphere";
    service.request.dimensions = {1.0};
    service.request.chord_error = 1e-5;  // hundreds of thousands of triangles: a second of work
    ros::service::call(kNode + "add_body", service);
    return service;
  });
  ros::WallDuration(0.2).sleep();  // it is at work then; later the test sees nothing, but does not fail
  reconfigure("cutoff", "5");
  const AddBody added = adding.get();
  ASSERT_TRUE(added.response.success) << added.response.message;
  ListBodies list;
  ASSERT_TRUE(ros::service::call(kNode + "list_bodies", list));
  for (const PairInfo& pair : list.response.pairs) {
    EXPECT_TRUE(pair.body_a != "late" || pair.cutoff == 5.0) << pair.name << ": " << pair.cutoff;
  }
  reconfigure("cutoff", "none");
  RemoveBody removal;
  removal.request.name = "late";
  EXPECT_TRUE(ros::service::call(kNode + "remove_body", removal) && removal.response.success);
}

}  // namespace
}  // namespace concave_distance::topics_rostest
