// The poses of many frames in a cycle, against those of each pair alone.
#include "ros/tf/frame_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ros/transform_message.h"

namespace concave_distance::frame_poses_test {
namespace {

const ros::Time kStart(100, 0);

ros::Time at(double seconds) {
  return kStart + ros::Duration(seconds);
}

void put(tf2::BufferCore& buffer, const std::string& parent, const std::string& child, double x,
         ros::Time stamp, bool fixed = false) {
  buffer.setTransform(test::transformOf(child, x, stamp, parent), "test", fixed);
}

struct Common {
  bool is_located = false;
  bool is_fixed = false;
  std::size_t time = 0;
};

// The earlier of the newest times of two bodies, as SceneTracker takes it.
Common commonOf(const BodyPoses& poses, std::size_t a, std::size_t b) {
  Common common;
  common.is_fixed = poses.newest[a] == BodyPoses::kFixed && poses.newest[b] == BodyPoses::kFixed;
  if (poses.newest[a] == BodyPoses::kUnknown || poses.newest[b] == BodyPoses::kUnknown) return common;
  const std::int32_t end = std::numeric_limits<std::int32_t>::max();
  const auto newest = [&](std::size_t body) {
    return poses.newest[body] == BodyPoses::kFixed ? end : poses.newest[body];
  };
  const std::int32_t time = std::min(newest(a), newest(b));
  common.time = time == end ? 0 : static_cast<std::size_t>(time);
  common.is_located = common.is_fixed || time >= std::max(poses.oldest[a], poses.oldest[b]);
  return common;
}

// Trees of frames, fixed and moving, of at most four publishers with times of their own.
TEST(FramePoses, AreThoseOfEachPairAlone) {
  std::size_t located = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 engine(seed);
    const auto below = [&](unsigned n) { return static_cast<unsigned>(engine() % n); };
    tf2::BufferCore buffer;
    std::vector<std::string> frames;
    const unsigned publishers = 1 + below(3);
    for (int i = 0; i < 14; ++i) {
      const std::string name = "f" + std::to_string(i);
      const bool is_alone = below(12) == 0;
      const std::string parent = is_alone         ? "elsewhere"
                                 : frames.empty() ? std::string("root")
                                                  : frames[below(static_cast<unsigned>(frames.size()))];
      const bool is_fixed = below(3) == 0;
      const double newest = 0.13 * below(publishers);
      for (int k = 0; k <= (is_fixed ? 0 : 20); ++k) {
        geometry_msgs::TransformStamped transform =
            test::transformOf(name, 0.3 * i + 0.01 * k, at(newest - 0.05 * (20 - k)), parent);
        const double angle = 0.1 * below(60);
        transform.transform.rotation.z = std::sin(0.5 * angle);
        transform.transform.rotation.w = std::cos(0.5 * angle);
        buffer.setTransform(transform, "test", is_fixed);
      }
      frames.push_back(name);
    }
    const std::string reference = below(2) == 0 ? "root" : frames[below(14)];
    FramePoses poses;
    poses.setFrames(reference, frames, ros::Time());
    std::vector<Eigen::Isometry3d> places;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      places.emplace_back(Eigen::Translation3d(0.1 * below(9), 0.0, 0.2) *
                          Eigen::AngleAxisd(0.1 * below(60), Eigen::Vector3d::UnitX()));
    }
    poses.setPlaces(places);
    const ros::Time now = at(below(2) == 0 ? 0.3 : 0.1);
    poses.update(buffer, now, 1.0);
    for (std::size_t a = 0; a < frames.size(); ++a) {
      for (std::size_t b = 0; b < frames.size(); ++b) {
        PairAncestors ancestors;
        const PairTransforms expected =
            lookUpPair(buffer, {reference, frames[a], frames[b]}, now, 1.0, ancestors);
        const Common common = commonOf(poses.poses(), a, b);
        ASSERT_EQ(common.is_located, expected.status == TransformStatus::Ok)
            << "seed " << seed << ": " << frames[a] << ", " << frames[b] << ": " << expected.message;
        if (!common.is_located) continue;
        ++located;
        ASSERT_EQ(common.is_fixed, expected.fixed);
        if (!common.is_fixed) {
          ASSERT_EQ(poses.commonStamp(a, b), expected.stamp) << "seed " << seed;
        }
        const auto error = [](const Eigen::Isometry3d& l, const Eigen::Isometry3d& r) {
          return (l.matrix() - r.matrix()).cwiseAbs().maxCoeff();
        };
        ASSERT_LE(error(poses.poses().relative(a, b, common.time),
                        places[a].inverse() * expected.a_from_b * places[b]),
                  1e-9);
        ASSERT_LE(error(poses.referenceFrom(a, b), expected.reference_from_a * places[a]), 1e-9);
      }
    }
  }
  EXPECT_GT(located, 2000U);
}

TEST(FramePoses, LoseNothingFarFromTheRoot) {
  tf2::BufferCore buffer;
  put(buffer, "world", "base", 1e9, kStart, true);
  put(buffer, "base", "a", 0.1, kStart);
  put(buffer, "base", "b", 0.3, kStart);
  FramePoses poses;
  poses.setFrames("world", {"a", "b"}, ros::Time());
  poses.update(buffer, kStart, 1.0);
  EXPECT_NEAR(poses.poses().relative(0, 1, 0).translation().x(), 0.2, 1e-15);
}

TEST(FramePoses, SayWhatIsMissingAndWhatIsOld) {
  tf2::BufferCore buffer;
  put(buffer, "world", "a", 1.0, at(0.0));
  put(buffer, "world", "b", 2.0, at(-5.0));
  put(buffer, "moon", "c", 2.0, at(0.0));
  FramePoses poses;
  poses.setFrames("world", {"a", "b", "c", "nowhere", "world"}, ros::Time());
  poses.update(buffer, at(0.0), 1.0);
  EXPECT_EQ(poses.place(0).status, TransformStatus::Ok);
  EXPECT_EQ(poses.place(1).status, TransformStatus::Stale);
  EXPECT_EQ(poses.place(1).stamp, at(-5.0));
  EXPECT_EQ(poses.poses().newest[1], BodyPoses::kUnknown);
  for (const std::size_t missing : {2U, 3U}) {
    EXPECT_EQ(poses.place(missing).status, TransformStatus::Missing);
    EXPECT_NE(poses.place(missing).message.find(missing == 2 ? "c" : "nowhere"), std::string::npos);
  }
  EXPECT_EQ(poses.poses().newest[4], BodyPoses::kFixed);
  put(buffer, "world", "moon", 7.0, at(0.0), true);
  poses.update(buffer, at(0.0), 1.0);
  EXPECT_EQ(poses.place(2).status, TransformStatus::Ok) << "connected later";
}

// A body that moves in its own time; its newest one is not held back by that of another far behind.
TEST(FramePoses, HaveFourTimesAtMostOfManyPublishers) {
  tf2::BufferCore buffer;
  std::vector<std::string> frames;
  for (int i = 0; i < 50; ++i) {
    const std::string name = "f" + std::to_string(i);
    const double newest = i == 0 ? -0.5 : 0.001 * i;
    for (int k = 0; k <= 10; ++k) put(buffer, "world", name, newest + 0.1 * k, at(newest - 0.1 * (10 - k)));
    frames.push_back(name);
  }
  FramePoses poses;
  poses.setFrames("world", frames, at(0.0));
  poses.update(buffer, at(0.1), 1.0);
  EXPECT_EQ(poses.poses().times.size(), FramePoses::kMostTimes);
  EXPECT_EQ(poses.poses().newest[0], 0);
  EXPECT_NEAR(poses.poses().times[0], -0.5, 1e-9);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto newest = static_cast<std::size_t>(poses.poses().newest[i]);
    EXPECT_LE(poses.poses().times[newest], 0.001 * static_cast<double>(i) + 1e-9);
    EXPECT_GE(poses.poses().times[newest], 0.001 * static_cast<double>(i) - 0.017)
        << "a third of what they differ by, one of four times being that of the first";
    // Its transforms say that x is its newest time at the beginning and grows like the time.
    const double seconds = poses.poses().times[newest];
    EXPECT_NEAR(poses.poses().pose(i, newest).translation().x(), seconds + 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace concave_distance::frame_poses_test
