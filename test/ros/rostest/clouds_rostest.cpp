// Clouds and maps of a running node: distances to their voxels, what is late, empty, malformed or on the
// robot, and edits.
#include <concave_distance/ApplyScene.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/Reload.h>
#include <concave_distance/RemoveBody.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <ros/publisher.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <sstream>
#include <thread>

#include "node_access.h"
#include "ros/clouds/received_message.h"
#include "tf_player.h"

namespace concave_distance::clouds_rostest {
namespace {

using Point = std::array<float, 3>;

constexpr double kVoxel = 0.1;
constexpr double kHalfProbe = 0.1;

sensor_msgs::PointCloud2 cloudOf(const std::vector<Point>& points, const std::string& frame) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> at(cloud, "x");
  for (const Point& point : points) {
    for (int k = 0; k < 3; ++k) at[k] = point[static_cast<std::size_t>(k)];
    ++at;
  }
  return cloud;
}

/// Publishes the same points again and again with the time of now, as a sensor does.
class Sensor {
 public:
  explicit Sensor(const std::string& topic)
      : publisher_(node_.advertise<sensor_msgs::PointCloud2>(topic, 1)), thread_([this] { play(); }) {}
  ~Sensor() {
    runs_ = false;
    thread_.join();
  }
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;

  void see(const std::vector<Point>& points, const std::string& frame = "world") {
    show(cloudOf(points, frame));
  }
  void show(const sensor_msgs::PointCloud2& cloud) {
    const std::lock_guard<std::mutex> lock(mutex_);
    cloud_ = cloud;
    is_on_ = true;
  }
  void switchOff() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_on_ = false;
  }

 private:
  void play() {
    while (runs_) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        cloud_.header.stamp = ros::Time::now();
        if (is_on_) publisher_.publish(cloud_);
      }
      ros::WallDuration(0.05).sleep();
    }
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::mutex mutex_;
  sensor_msgs::PointCloud2 cloud_;
  bool is_on_ = false;
  std::atomic<bool> runs_{true};
  std::thread thread_;
};

/// Frames at rest, the listener to distances, and the sensor.
struct Cell {
  Cell() : distances(kNode + "distances") {
    player.place("probe", 0.0);
    player.place("base", -10.0);
    player.place("slide", -10.0);
    player.place("tip", 10.0);
  }

  const PairDistance* find(const Distances& message, const std::string& pair) const {
    const auto found = std::find_if(message.pairs.begin(), message.pairs.end(),
                                    [&](const PairDistance& distance) { return distance.pair == pair; });
    return found == message.pairs.end() ? nullptr : &*found;
  }
  bool waitForStatus(const std::string& pair, std::uint8_t code, const std::string& text) {
    return distances.waitFor([&](const Distances& message) {
      const PairDistance* found = find(message, pair);
      return found != nullptr && found->status.code == code &&
             found->status.message.find(text) != std::string::npos;
    });
  }
  bool waitForDistance(const std::string& pair, double expected) {
    return distances.waitFor([&](const Distances& message) {
      const PairDistance* found = find(message, pair);
      return found != nullptr && found->has_distance != 0 && found->has_lower_bound != 0 &&
             std::abs(found->distance - expected) <= 1e-9 && found->lower_bound <= expected + kRounding &&
             found->lower_bound >= expected - 1e-6;
    });
  }

  TfPlayer player;
  Collector<Distances> distances;
  Sensor sensor{"/points"};
};

PairNiches query(const std::string& body_a, const std::string& body_b) {
  GetDistanceRequest request;
  request.query.body_a = body_a;
  request.query.body_b = body_b;
  return call<GetDistance>(kNode + "get_distance", request).result;
}

// The probe at the origin, a voxel whose corner is at (x, 0, 0).
double gapTo(double x) {
  return x - kHalfProbe;
}

TEST(Clouds, AreMissingThenServedThenStaleThenEmpty) {
  Cell cell;
  EXPECT_TRUE(
      cell.waitForStatus("probe_seen", PairStatus::MISSING_TRANSFORM, "nothing has come on 'points'"));
  EXPECT_EQ(query("probe", "seen").nearest.status.code, PairStatus::MISSING_TRANSFORM);

  cell.sensor.see({{2.05F, 0.05F, 0.05F}, {4.0F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.0)));
  const PairNiches answer = query("probe", "seen");
  EXPECT_NEAR(answer.nearest.distance, gapTo(2.0), 1e-9);
  cell.sensor.see({{3.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(3.0)));

  cell.sensor.switchOff();
  EXPECT_TRUE(cell.waitForStatus("probe_seen", PairStatus::STALE_TRANSFORM, "stale_after is 1.5 s"));
  EXPECT_EQ(query("probe", "seen").nearest.status.code, PairStatus::STALE_TRANSFORM);

  cell.sensor.see({});
  EXPECT_TRUE(eventually([&] {
    const PairNiches empty = query("probe", "seen");
    return empty.nearest.status.code == PairStatus::BEYOND_CUTOFF && empty.nearest.has_lower_bound != 0 &&
           std::isinf(empty.nearest.lower_bound);
  }));
  EXPECT_TRUE(cell.distances.waitFor([&](const Distances& message) {
    return cell.find(message, "probe_seen") == nullptr && message.pairs_beyond_cutoff > 0;
  }));
  cell.sensor.see({{2.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.0)));
}

TEST(Clouds, StandWhereTheSensorSeesThem) {
  Cell cell;
  cell.player.place("camera", 0.0, 5.0, 0.0, -M_PI / 2);      // its x axis is the world's -y
  cell.sensor.see({{5.0F - 0.05F, 2.45F, 0.05F}}, "camera");  // at (2.45, 0.05, 0.05)
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.4)));
  // Beyond the range of 30 m nothing counts.
  cell.sensor.see({{31.0F, 0.0F, 0.0F}, {5.0F - 0.05F, 1.45F, 0.05F}}, "camera");
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(1.4)));
  EXPECT_TRUE(std::isfinite(query("probe", "seen").nearest.distance));
}

TEST(Clouds, PointsOnTheMovingRobotDoNotCount) {
  Cell cell;
  cell.player.place("probe", 0.0, 20.0);
  const Point wall{4.05F, 0.05F, 0.05F};
  // On the surface of the tip, a box of side 1 at `x`, and up to 4 cm beside it.
  const auto sight = [&](double x) {
    std::vector<Point> points{wall};
    for (int i = 0; i <= 10; ++i) {
      for (int k = 0; k <= 10; ++k) {
        const float y = -0.5F + 0.1F * static_cast<float>(i);
        const float z = -0.5F + 0.1F * static_cast<float>(k);
        points.push_back({static_cast<float>(x) + 0.5F + 0.004F * static_cast<float>(i), y, z});
        points.push_back({static_cast<float>(x) - 0.3F, y, z});
      }
    }
    return points;
  };
  for (const double x : {0.0, 0.7, 1.3, 2.0}) {
    cell.player.place("tip", x);
    // tf may be a cycle behind the sensor.
    cell.sensor.switchOff();
    ros::WallDuration(0.2).sleep();
    cell.sensor.see(sight(x));
    EXPECT_TRUE(cell.waitForDistance("tip_seen", 4.0 - (x + 0.5))) << x;
  }
  // No cloud is used before tf says where the robot was at its stamp.
  cell.distances.clear();
  std::size_t answered = 0;
  ASSERT_TRUE(eventually([&] { return cell.distances.count() >= 50; }));
  for (const Distances& message : cell.distances.all()) {
    const PairDistance* found = cell.find(message, "tip_seen");
    if (found == nullptr || found->has_distance == 0) continue;
    ++answered;
    EXPECT_NEAR(found->distance, 4.0 - 2.5, 1e-9);
  }
  EXPECT_GT(answered, 0U);
  // A point farther away than the padding of 5 cm is an obstacle.
  std::vector<Point> points = sight(2.0);
  points.push_back({2.75F, 0.05F, 0.05F});
  cell.sensor.see(points);
  EXPECT_TRUE(cell.waitForDistance("tip_seen", 2.7 - 2.5));
}

TEST(Clouds, MalformedMessagesAreRefusedAndTheLastOneStays) {
  Cell cell;
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  cell.sensor.see({{2.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.0)));
  const auto expect_refusal = [&](const sensor_msgs::PointCloud2& cloud, const std::string& text) {
    cell.sensor.show(cloud);
    EXPECT_TRUE(diagnostics.waitFor([&](const diagnostic_msgs::DiagnosticArray& message) {
      return diagnosed(message, "seen last refusal").find(text) != std::string::npos;
    })) << text;
  };
  sensor_msgs::PointCloud2 cloud = cloudOf({{1.05F, 0.05F, 0.05F}}, "world");
  cloud.fields.pop_back();
  expect_refusal(cloud, "there is no 'z'");
  cloud = cloudOf({{1.05F, 0.05F, 0.05F}}, "world");
  cloud.data.clear();
  expect_refusal(cloud, "0 bytes for");
  cloud = cloudOf({{1.05F, 0.05F, 0.05F}}, "nowhere");
  expect_refusal(cloud, "nowhere");
  cloud = cloudOf({{1.05F, 0.05F, 0.05F}}, "");
  expect_refusal(cloud, "frame_id");
  std::vector<Point> many(300'000);
  for (std::size_t i = 0; i < many.size(); ++i)
    many[i] = {0.05F + 0.1F * static_cast<float>(i % 100), 0.05F + 0.1F * static_cast<float>(i / 100 % 100),
               1.05F + 0.1F * static_cast<float>(i / 10000)};
  expect_refusal(cloudOf(many, "world"), "more than 200000 voxels");
  EXPECT_TRUE(cell.waitForStatus("probe_seen", PairStatus::STALE_TRANSFORM, "cloud 'seen'"));
  cell.sensor.see({{1.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(1.0)));
}

TEST(Clouds, AreServedAfterAPublisherOfAnotherType) {
  Cell cell;
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  {
    ros::NodeHandle node;
    const ros::Publisher wrong = node.advertise<std_msgs::String>("/odd_points", 1);
    EXPECT_TRUE(eventually([&] {
      wrong.publish(std_msgs::String());
      return diagnostics.waitFor(
          [](const diagnostic_msgs::DiagnosticArray& message) {
            return diagnosed(message, "odd last refusal").find("std_msgs/String") != std::string::npos;
          },
          0.5);
    }));
  }
  Sensor sensor("/odd_points");
  sensor.see({{1.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_odd", gapTo(1.0)));
}

test::OctomapMessage mapOf(const std::vector<Point>& occupied, const std::string& frame) {
  octomap::OcTree tree(0.25);
  for (const Point& point : occupied) tree.updateNode(octomap::point3d(point[0], point[1], point[2]), true);
  std::ostringstream bytes;
  tree.writeBinaryData(bytes);
  const std::string text = bytes.str();
  test::OctomapMessage message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time::now();
  message.resolution = tree.getResolution();
  message.data.assign(text.begin(), text.end());
  return message;
}

TEST(Clouds, MapsAreServedInTheirOwnFrameAndStay) {
  Cell cell;
  cell.player.place("map_frame", 1.0, 0.0, 0.0);
  ros::NodeHandle node;
  topic_tools::ShapeShifter shape = test::asReceived(mapOf({{2.1F, 0.1F, 0.1F}}, "world"));
  const ros::Publisher publisher = shape.advertise(node, "/octomap", 1, true);
  publisher.publish(shape);
  EXPECT_TRUE(cell.waitForDistance("probe_map", gapTo(2.0)));
  publisher.publish(test::asReceived(mapOf({{2.1F, 0.1F, 0.1F}, {5.1F, 0.1F, 0.1F}}, "map_frame")));
  EXPECT_TRUE(cell.waitForDistance("probe_map", gapTo(3.0)));
  // Older than the limit of the cloud, yet a map stays.
  EXPECT_NEAR(query("probe", "map").nearest.distance, gapTo(3.0), 1e-9);
}

TEST(Clouds, EditsLeaveThemAndOnlyRemovingTakesThem) {
  Cell cell;
  cell.sensor.see({{2.05F, 0.05F, 0.05F}});
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.0)));
  ApplySceneRequest request;
  request.operations.resize(1);
  request.operations[0].operation = SceneOperation::MOVE;
  request.operations[0].body = "seen";
  request.operations[0].pose.position.x = 1.0;
  const ApplySceneResponse moved = call<ApplyScene>(kNode + "apply_scene", request);
  EXPECT_FALSE(moved.success);
  EXPECT_NE(moved.message.find("is a cloud"), std::string::npos) << moved.message;
  const ReloadResponse reloaded = call<Reload>(kNode + "reload", ReloadRequest());
  EXPECT_TRUE(reloaded.success) << reloaded.message;
  EXPECT_EQ(std::count(reloaded.kept.begin(), reloaded.kept.end(), "seen"), 1);
  EXPECT_NEAR(query("probe", "seen").nearest.distance, gapTo(2.0), 1e-9);
  RemoveBodyRequest removal;
  removal.name = "seen";
  EXPECT_TRUE(call<RemoveBody>(kNode + "remove_body", removal).success);
  EXPECT_TRUE(cell.distances.waitFor(
      [&](const Distances& message) { return cell.find(message, "probe_seen") == nullptr; }));
  ReloadRequest again;
  again.drop_edits = 1;
  EXPECT_TRUE(call<Reload>(kNode + "reload", again).success);
  EXPECT_TRUE(cell.waitForDistance("probe_seen", gapTo(2.0)));
}

}  // namespace
}  // namespace concave_distance::clouds_rostest
