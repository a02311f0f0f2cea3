// A bag of the demo robot is played to a real node, each stamp until it is answered; distance_bag has to
// write the same answers.
#include <concave_distance/Niches.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "node_access.h"
#include "run_node.h"
#include "support/csv_table.h"
#include "support/temporary_folder.h"

namespace concave_distance::bags_rostest {
namespace {

using test::number;
using test::Row;

constexpr int kStamps = 150;
constexpr double kRate = 50.0;            // Hz
constexpr double kPreparingStep = 0.005;  // s
constexpr double kClockStep = 0.0005;     // s, far less than between two stamps
constexpr double kMostAhead = 0.015;      // s that the clock may be ahead of a stamp
constexpr double kBetweenSteps = 0.002;   // s of wall time

using Key = std::pair<std::string, std::string>;  // pair and stamp

std::string textOf(ros::Time time) {
  const std::string nanoseconds = std::to_string(time.nsec);
  return std::to_string(time.sec) + "." + std::string(9 - nanoseconds.size(), '0') + nanoseconds;
}

/// Publishes the messages of a bag and holds the clock until the node has answered.
class SteppedPlayer {
 public:
  explicit SteppedPlayer(const std::string& path)
      : clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", 10)),
        moving_(node_.advertise<tf2_msgs::TFMessage>("/tf", 100)),
        fixed_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", 100, true)) {
    rosbag::Bag bag(path);
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      (message.getTopic() == "/tf" ? moves_ : stands_).push_back(*message.instantiate<tf2_msgs::TFMessage>());
    }
  }

  std::size_t stampCount() const { return moves_.size(); }
  ros::Time stamp(std::size_t index) const { return moves_[index].transforms.front().header.stamp; }
  bool isHeard() const { return moving_.getNumSubscribers() > 0 && fixed_.getNumSubscribers() > 0; }
  void standStill() {
    for (const tf2_msgs::TFMessage& message : stands_) fixed_.publish(message);
  }
  /// Stands where the bag begins, from so many seconds before, until the condition holds. The node
  /// refuses transforms until its clock has come there: they are sent again and again.
  bool standBefore(double seconds, const std::function<bool()>& is_ready) {
    ros::Time now = stamp(0) - ros::Duration(seconds);
    const ros::Time end = stamp(0) - ros::Duration(0.2 * seconds);
    return eventually(
        [&] {
          if (now < end) now += ros::Duration(kPreparingStep);
          tf2_msgs::TFMessage message = moves_.front();
          for (auto& transform : message.transforms) transform.header.stamp = now;
          moving_.publish(message);
          publishClock(now);
          ros::WallDuration(kBetweenSteps).sleep();
          return is_ready();
        },
        60.0);
  }
  /// Steps the clock on from the stamp until the condition holds.
  bool play(std::size_t index, const std::function<bool()>& is_answered) {
    moving_.publish(moves_[index]);
    double ahead = 0.0;
    return eventually(
        [&] {
          publishClock(stamp(index) + ros::Duration(ahead));
          ahead = std::min(ahead + kClockStep, kMostAhead);
          ros::WallDuration(kBetweenSteps).sleep();
          return is_answered();
        },
        60.0);
  }

 private:
  void publishClock(ros::Time now) {
    rosgraph_msgs::Clock message;
    message.clock = now;
    clock_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Publisher moving_;
  ros::Publisher fixed_;
  std::vector<tf2_msgs::TFMessage> moves_;
  std::vector<tf2_msgs::TFMessage> stands_;
};

/// Every pair that the message solves has a whole list, and is of this stamp or, where it may be, of a later.
bool isOfStamp(const Niches& message, ros::Time stamp, bool or_later = false) {
  bool has_any = false;
  for (const PairNiches& pair : message.pairs) {
    if (pair.nearest.has_distance == 0) continue;
    const ros::Time found = pair.header.stamp;
    if (pair.niches_complete == 0 || (or_later ? found < stamp : found != stamp)) return false;
    has_any = true;
  }
  return has_any;
}

void expectPoint(const Row& row, const std::string& prefix, double x, double y, double z,
                 const std::string& where) {
  EXPECT_EQ(number(row, prefix + "x"), x) << where;
  EXPECT_EQ(number(row, prefix + "y"), y) << where;
  EXPECT_EQ(number(row, prefix + "z"), z) << where;
}

void expectSame(const PairNiches& answer, const Row& row, const std::vector<Row>& niches) {
  const PairDistance& nearest = answer.nearest;
  const std::string where = nearest.pair + " at " + row.at("stamp");
  EXPECT_EQ(row.at("status"), "ok") << where;
  EXPECT_EQ(nearest.status.code, PairStatus::OK) << where;
  EXPECT_EQ(number(row, "distance"), nearest.distance) << where;
  EXPECT_EQ(number(row, "lower_bound"), nearest.lower_bound) << where;
  expectPoint(row, "a", nearest.point_a.x, nearest.point_a.y, nearest.point_a.z, where);
  expectPoint(row, "b", nearest.point_b.x, nearest.point_b.y, nearest.point_b.z, where);
  expectPoint(row, "n", nearest.normal.x, nearest.normal.y, nearest.normal.z, where);
  EXPECT_EQ(row.at("warning"), nearest.warning != 0 ? "1" : "0") << where;
  ASSERT_EQ(niches.size(), answer.niches.size()) << where;
  for (std::size_t i = 0; i < niches.size(); ++i) {
    const Niche& niche = answer.niches[i];
    EXPECT_EQ(number(niches[i], "distance"), niche.distance) << where;
    expectPoint(niches[i], "a", niche.point_a.x, niche.point_a.y, niche.point_a.z, where);
    expectPoint(niches[i], "b", niche.point_b.x, niche.point_b.y, niche.point_b.z, where);
    EXPECT_EQ(niches[i].at("visible"), niche.visible != 0 ? "1" : "0") << where;
  }
}

TEST(Bags, DistanceBagGivesTheNodesAnswersOnTheSameStamps) {
  const test::TemporaryFolder folder;
  const std::string source = CONCAVE_DISTANCE_SOURCE_DIR;
  const std::string bag = folder.path("run.bag");
  const Ended written = runCommand("/usr/bin/python3 " + source + "/scripts/write_robot_bag.py --output " +
                                   bag + " --seconds " + std::to_string(kStamps / kRate) + " --rate " +
                                   std::to_string(kRate) + " 2>&1");
  ASSERT_EQ(written.exit_code, 0) << written.output;
  SteppedPlayer player(bag);
  ASSERT_EQ(player.stampCount(), static_cast<std::size_t>(kStamps));
  Collector<Niches> niches(kNode + "niches");
  ASSERT_TRUE(eventually([&] { return player.isHeard(); }));
  player.standStill();
  const auto is_after = [&](double seconds) {
    const auto last = niches.last();
    return last && isOfStamp(*last, player.stamp(0) - ros::Duration(seconds), true);
  };
  // Until then the node gives distances alone, because it prepares the bodies for niches.
  ASSERT_TRUE(player.standBefore(60.0, [&] { return is_after(60.0); }));
  // Its clock and the clock of its transforms have to be near the first stamp.
  ASSERT_TRUE(player.standBefore(0.5, [&] { return is_after(0.5); }));
  std::map<Key, PairNiches> of_node;
  for (std::size_t i = 0; i < player.stampCount(); ++i) {
    ASSERT_TRUE(player.play(i,
                            [&] {
                              const auto last = niches.last();
                              return last && isOfStamp(*last, player.stamp(i));
                            }))
        << "stamp " << i;
    const Niches answered = *niches.last();
    for (const PairNiches& pair : answered.pairs) {
      if (pair.nearest.has_distance != 0) of_node[{pair.nearest.pair, textOf(pair.header.stamp)}] = pair;
    }
    niches.clear();
  }
  const std::string outputs =
      " --output " + folder.path("d.csv") + " --niches-output " + folder.path("n.csv");
  const Ended ended =
      runCommand(std::string(CONCAVE_DISTANCE_DISTANCE_BAG) + " --bag " + bag + " --scene " + source +
                 "/config/robot.yaml --robot-description " + source + "/urdf/wam.urdf" + outputs + " 2>&1");
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  std::map<Key, std::vector<Row>> niches_of_bag;
  for (const Row& row : test::readTable(folder.path("n.csv"))) {
    niches_of_bag[{row.at("pair"), row.at("stamp")}].push_back(row);
  }
  std::size_t compared = 0;
  for (const Row& row : test::readTable(folder.path("d.csv"))) {
    if (row.at("distance").empty()) continue;
    const Key key{row.at("pair"), row.at("stamp")};
    const auto found = of_node.find(key);
    ASSERT_NE(found, of_node.end()) << key.first << " at " << key.second;
    expectSame(found->second, row, niches_of_bag[key]);
    ++compared;
  }
  EXPECT_EQ(compared, of_node.size()) << "no answer of the node is missing";
  EXPECT_GT(compared, static_cast<std::size_t>(5 * kStamps));
}

}  // namespace
}  // namespace concave_distance::bags_rostest
