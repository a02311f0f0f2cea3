// Where bodies are by tf, alone and in pairs, against transforms composed edge by edge.
#include "ros/tf/tf_locate.h"

#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "ros/located_pair.h"

namespace concave_distance::tf_locate_test {
namespace {

using test::located;
using test::LocatedPair;

const ros::Time kStart(100, 0);

ros::Time at(double seconds) {
  return kStart + ros::Duration(seconds);
}

class TfLocateTest : public ::testing::Test {
 protected:
  void put(const std::string& parent, const std::string& child, double x, ros::Time stamp,
           bool fixed = false) {
    buffer->setTransform(test::transformOf(child, x, stamp, parent), "test", fixed);
  }
  LocatedPair look(const std::string& reference, const std::string& a, const std::string& b, ros::Time now,
                   double stale_after) {
    return located(buffer, reference, a, b, now, stale_after);
  }

  std::shared_ptr<tf2::BufferCore> buffer = std::make_shared<tf2::BufferCore>();
};

/// Frames, fixed and moving, of publishers with times of their own; with what they were made from.
struct RandomTree {
  static constexpr unsigned kFrames = 14;

  explicit RandomTree(unsigned seed) : engine(seed) {
    const unsigned publishers = 1 + below(5);
    for (unsigned i = 0; i < kFrames; ++i) {
      const std::string name = "f" + std::to_string(i);
      parent_of[name] = below(12) == 0 ? "elsewhere" : i == 0 ? "root" : "f" + std::to_string(below(i));
      const bool is_fixed = below(3) == 0;
      const double newest = 0.13 * below(publishers);
      if (!is_fixed) newest_of[name] = newest;
      for (int k = 0; k <= (is_fixed ? 0 : 20); ++k) {
        geometry_msgs::TransformStamped transform =
            test::transformOf(name, 0.3 * i + 0.01 * k, at(newest - 0.05 * (20 - k)), parent_of[name]);
        const double angle = 0.1 * below(60);
        transform.transform.rotation.z = std::sin(0.5 * angle);
        transform.transform.rotation.w = std::cos(0.5 * angle);
        buffer->setTransform(transform, "test", is_fixed);
      }
    }
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(engine() % n); }

  std::vector<std::string> upFrom(std::string frame) const {
    std::vector<std::string> chain{frame};
    while (parent_of.count(frame) != 0) chain.push_back(frame = parent_of.at(frame));
    return chain;
  }
  bool areConnected(const std::string& a, const std::string& b) const {
    return upFrom(a).back() == upFrom(b).back();
  }
  // The earliest of the newest times of the edges between two frames; infinite: all are fixed.
  double newestBetween(const std::string& a, const std::string& b) const {
    std::set<std::string> way;
    for (const std::string& end : {a, b}) {
      for (const std::string& frame : upFrom(end)) {
        if (!way.insert(frame).second) way.erase(frame);  // above the frame where the two ways meet
      }
    }
    double newest = std::numeric_limits<double>::infinity();
    for (const std::string& frame : way) {
      if (newest_of.count(frame) != 0) newest = std::min(newest, newest_of.at(frame));
    }
    return newest;
  }
  Eigen::Isometry3d fromTop(std::string frame, ros::Time stamp) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (; parent_of.count(frame) != 0; frame = parent_of.at(frame)) {
      // Only the edges that are asked for need to be known at that time.
      const auto newest = newest_of.find(frame);
      const ros::Time then = newest == newest_of.end() ? ros::Time(0) : std::min(stamp, at(newest->second));
      pose = tf2::transformToEigen(buffer->lookupTransform(parent_of.at(frame), frame, then)) * pose;
    }
    return pose;
  }

  std::mt19937 engine;
  std::shared_ptr<tf2::BufferCore> buffer = std::make_shared<tf2::BufferCore>();
  std::map<std::string, std::string> parent_of;
  std::map<std::string, double> newest_of;  ///< of frames that move
};

TEST(TfLocate, FindsEachPairAtItsOwnNewestTime) {
  std::size_t pairs = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    RandomTree tree(seed);
    std::vector<std::string> frames;
    std::vector<Eigen::Isometry3d> places;
    for (unsigned i = 0; i < RandomTree::kFrames; ++i) {
      frames.push_back("f" + std::to_string(i));
      places.emplace_back(Eigen::Translation3d(0.1 * tree.below(9), 0.0, 0.2) *
                          Eigen::AngleAxisd(0.1 * tree.below(60), Eigen::Vector3d::UnitX()));
    }
    const std::string reference = tree.below(2) == 0 ? "root" : frames[tree.below(RandomTree::kFrames)];
    const double now = tree.below(2) == 0 ? 0.6 : 0.1;
    TfLocate locate(reference);
    locate.setBodies(frames, places);
    locate.update(tree.buffer, at(now), 1.0);
    // One that is ahead of the clock is taken at the clock's time.
    const auto newest_of = [&](std::size_t body) {
      const double newest = tree.newestBetween(reference, frames[body]);
      return std::isfinite(newest) ? std::min(newest, now) : newest;
    };
    for (std::size_t a = 0; a < frames.size(); ++a) {
      const bool is_a_known = tree.areConnected(reference, frames[a]);
      ASSERT_EQ(locate.poses()[a].has_value(), is_a_known);
      if (!is_a_known) continue;
      const auto poseAt = [&](std::size_t body, double time) -> Eigen::Isometry3d {
        const ros::Time stamp = at(std::isfinite(time) ? time : 0.0);
        return tree.fromTop(frames[body], stamp) * places[body];
      };
      const auto reference_at = [&](double time) {
        return tree.fromTop(reference, at(std::isfinite(time) ? time : 0.0));
      };
      EXPECT_TRUE(
          locate.poses()[a]->isApprox(reference_at(newest_of(a)).inverse() * poseAt(a, newest_of(a)), 1e-12));
      for (std::size_t b = 0; b < frames.size(); ++b) {
        const double common = std::min(newest_of(a), newest_of(b));
        const PairInput input = locate(a, b);
        ASSERT_EQ(input.located, tree.areConnected(reference, frames[b]));
        if (!input.located) continue;
        ++pairs;
        ASSERT_EQ(input.fixed, !std::isfinite(common));
        const FrameTransform place = locate.placeOfA(a, b, true);
        EXPECT_EQ(place.stamp, at(input.fixed ? now : common));
        EXPECT_EQ(input.time, locate.seconds(at(input.fixed ? now : common)));
        EXPECT_TRUE(input.a_from_b.isApprox(poseAt(a, common).inverse() * poseAt(b, common), 1e-12))
            << "seed " << seed << ": " << frames[a] << ", " << frames[b];
        EXPECT_TRUE(
            place.target_from_source.isApprox(reference_at(common).inverse() * poseAt(a, common), 1e-12));
      }
    }
  }
  EXPECT_GT(pairs, 2000U);
}

// None is held back by another far behind, however many publishers there are.
TEST_F(TfLocateTest, TakesEachOfManyPublishersAtItsNewestTime) {
  std::vector<std::string> frames;
  const auto newest_of = [](std::size_t i) { return i == 0 ? -0.5 : 0.001 * static_cast<double>(i); };
  for (std::size_t i = 0; i < 50; ++i) {
    frames.push_back("f" + std::to_string(i));
    // x grows like the time.
    for (int k = 0; k <= 10; ++k) {
      put("world", frames[i], newest_of(i) - 0.1 * k, at(newest_of(i) - 0.1 * k));
    }
  }
  TfLocate locate("world");
  locate.setBodies(frames, std::vector<Eigen::Isometry3d>(50, Eigen::Isometry3d::Identity()));
  locate.update(buffer, at(0.1), 1.0);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(locate.poses()[i]->translation().x(), newest_of(i), 1e-9);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(locate.placeOfA(i, j, true).stamp, at(newest_of(j)));
      EXPECT_NEAR(locate(i, j).a_from_b.translation().x(), 0.0, 1e-9) << "both at one time";
    }
  }
}

TEST_F(TfLocateTest, LoseNothingFarFromTheRoot) {
  for (const bool is_fixed : {true, false}) {
    buffer->clear();
    put("world", is_fixed ? "base" : "moving", 1e9, kStart, is_fixed);
    const std::string base = is_fixed ? "base" : "moving";
    put(base, base + "/a", 0.1, kStart);
    put(base, base + "/arm", 0.5, kStart);
    put(base + "/arm", base + "/b", -0.2, kStart);
    // Subtractions of numbers below 1; through the world 1e9 would leave 1e-7.
    EXPECT_NEAR(look("world", base + "/a", base + "/b", kStart, 1.0).a_from_b.translation().x(), 0.2, 1e-15);
  }
}

TEST_F(TfLocateTest, SaysWhatIsMissingAndWhatIsOld) {
  put("world", "a", 1.0, at(0.0));
  put("world", "b", 2.0, at(-5.0));
  put("moon", "c", 2.0, at(0.0));
  TfLocate locate("world");
  locate.setBodies({"a", "b", "c", "nowhere", "world"},
                   std::vector<Eigen::Isometry3d>(5, Eigen::Isometry3d::Identity()));
  locate.update(buffer, at(0.0), 1.0);
  EXPECT_EQ(locate.place(0).status, TransformStatus::Ok);
  EXPECT_EQ(locate.place(1).status, TransformStatus::Stale);
  EXPECT_EQ(locate.place(1).stamp, at(-5.0));
  EXPECT_FALSE(locate.poses()[1]);
  for (const std::size_t missing : {2U, 3U}) {
    EXPECT_EQ(locate.place(missing).status, TransformStatus::Missing);
    EXPECT_NE(locate.place(missing).message.find(missing == 2 ? "c" : "nowhere"), std::string::npos);
    EXPECT_FALSE(locate.poses()[missing]);
    EXPECT_FALSE(locate(0, missing).located);
  }
  EXPECT_EQ(locate.place(4).status, TransformStatus::Ok);
  EXPECT_TRUE(locate.place(4).stamp.isZero());
  put("world", "moon", 7.0, at(0.0), true);
  locate.update(buffer, at(0.0), 1.0);
  EXPECT_EQ(locate.place(2).status, TransformStatus::Ok) << "connected later";
  locate.hide(2, {TransformStatus::Stale, "an old cloud", at(-7.0)});
  EXPECT_FALSE(locate(0, 2).located);
  EXPECT_EQ(locate.placeOfA(0, 2, false).message, "an old cloud");
}

TEST_F(TfLocateTest, ABodyThatWasNowhereBeforeHasNoTimeInCommonWithASlowOneYet) {
  put("world", "slow", 1.0, at(-0.5));
  put("world", "new", 2.0, at(0.0));
  const LocatedPair pair = look("world", "slow", "new", at(0.0), 1.0);
  EXPECT_EQ(pair.place.status, TransformStatus::Missing);
  EXPECT_EQ(pair.place.message, "the transforms of 'slow' and 'new' have no time in common yet");
}

TEST_F(TfLocateTest, TakesTheNewestTimeCommonToBothBodiesAndTheReference) {
  for (int i = 0; i <= 10; ++i) put("world", "base", 0.0, at(0.1 * i));
  for (int i = 0; i <= 20; ++i) {
    put("base", "a", 1.0, at(0.1 * i));
    put("base", "b", 1.0 + 0.1 * i, at(0.1 * i));
  }
  const LocatedPair pair = look("world", "a", "b", at(2.0), 10.0);
  ASSERT_EQ(pair.place.status, TransformStatus::Ok) << pair.place.message;
  EXPECT_EQ(pair.place.stamp, at(1.0)) << "the reference frame is known no further";
  EXPECT_NEAR(pair.a_from_b.translation().x(), 1.0, 1e-9);
  EXPECT_NEAR(pair.place.target_from_source.translation().x(), 1.0, 1e-9);
  EXPECT_FALSE(pair.fixed);
}

TEST_F(TfLocateTest, TakesStaticFramesAtTheTimeAskedAtAndNeverAsStale) {
  put("world", "a", 1.0, kStart, true);
  put("world", "b", 3.0, kStart, true);
  const LocatedPair pair = look("world", "a", "b", at(1e4), 1.0);
  ASSERT_EQ(pair.place.status, TransformStatus::Ok) << pair.place.message;
  EXPECT_TRUE(pair.fixed);
  EXPECT_EQ(pair.place.stamp, at(1e4));
  EXPECT_NEAR(pair.a_from_b.translation().x(), 2.0, 1e-12);
}

TEST_F(TfLocateTest, SaysMissingWithTheFramesName) {
  put("world", "a", 1.0, kStart);
  const LocatedPair pair = look("world", "a", "nowhere", at(0.0), 1.0);
  EXPECT_EQ(pair.place.status, TransformStatus::Missing);
  EXPECT_NE(pair.place.message.find("nowhere"), std::string::npos) << pair.place.message;
  EXPECT_EQ(look("universe", "a", "world", at(0.0), 1.0).place.status, TransformStatus::Missing);
  EXPECT_EQ(look("world", "", "a", at(0.0), 1.0).place.status, TransformStatus::Missing);
  EXPECT_EQ(look("world", "/a", "a", at(0.0), 1.0).place.status, TransformStatus::Missing);
}

TEST_F(TfLocateTest, SaysStaleWithTheAge) {
  put("world", "a", 1.0, kStart);
  put("world", "b", 2.0, kStart);
  put("world", "b", 2.0, at(3.0));
  const LocatedPair pair = look("world", "a", "b", at(3.0), 1.0);
  EXPECT_EQ(pair.place.status, TransformStatus::Stale);
  EXPECT_EQ(pair.place.stamp, kStart);
  EXPECT_EQ(pair.place.message,
            "the newest transform between 'a', 'b' and 'world' is 3 s old; ~stale_after is 1 s");
}

TEST_F(TfLocateTest, AnswersAtAGivenTimeOrSaysWhyNot) {
  put("world", "a", 0.0, at(0.0));
  put("world", "a", 1.0, at(1.0));
  put("world", "b", 5.0, kStart, true);
  const LocatedPair pair = located(buffer, "world", "a", "b", at(900.0), 1.0, at(0.5));
  ASSERT_EQ(pair.place.status, TransformStatus::Ok) << pair.place.message << ", however old";
  EXPECT_EQ(pair.place.stamp, at(0.5));
  EXPECT_NEAR(pair.a_from_b.translation().x(), 4.5, 1e-9);
  EXPECT_NEAR(pair.place.target_from_source.translation().x(), 0.5, 1e-9);
  EXPECT_EQ(located(buffer, "world", "a", "b", at(900.0), 1.0, at(1.5)).place.status,
            TransformStatus::Missing);
  EXPECT_EQ(located(buffer, "world", "world", "b", at(900.0), 1.0, at(1.5)).place.stamp, at(1.5));
}

TEST_F(TfLocateTest, FindsTheWayAgainWhenTheTreeChanges) {
  put("world", "base", 1.0, kStart);
  put("base", "a", 1.0, kStart);
  put("base", "b", 2.0, kStart);
  TfLocate locate("world");
  locate.setBodies({"a", "b"}, std::vector<Eigen::Isometry3d>(2, Eigen::Isometry3d::Identity()));
  locate.update(buffer, kStart, 1.0);
  EXPECT_NEAR(locate(0, 1).a_from_b.translation().x(), 1.0, 1e-12);
  put("world", "a", 5.0, at(1.0));  // picked up: it does not hang on the base any more
  put("world", "base", 1.0, at(1.0));
  put("base", "b", 2.0, at(1.0));
  locate.update(buffer, at(1.0), 1.0);
  EXPECT_NEAR(locate(0, 1).a_from_b.translation().x(), -2.0, 1e-12);
}

TEST_F(TfLocateTest, CountsSecondsFromOneInstantForNodesOfAboutOneAge) {
  TfLocate one("world");
  TfLocate other("world");
  one.update(buffer, ros::Time(1'700'000'000, 5));
  other.update(buffer, ros::Time(1'700'000'100, 7));
  const ros::Time stamp(1'700'000'200, 123'456'789);
  EXPECT_EQ(one.seconds(stamp), other.seconds(stamp));
  other.update(buffer, ros::Time(1'700'900'000, 0));
  EXPECT_EQ(one.seconds(stamp), other.seconds(stamp)) << "which stays";
  EXPECT_LT(one.seconds(stamp), 1e5) << "so that a double has nanoseconds";
}

}  // namespace
}  // namespace concave_distance::tf_locate_test
