// Which pairs of a scene of many bodies have a tracker, against every pair of bodies tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "concave_distance/scene/scene_tracker.h"
#include "scene/scene_edits.h"
#include "support/box_scene.h"
#include "support/scene_fixture.h"

namespace concave_distance::near_pairs_test {
namespace {

using Poses = std::vector<std::optional<Eigen::Isometry3d>>;
constexpr PairDemand kDistance{true, true, false, false};
constexpr PairDemand kNiches{true, true, true, false};

/// Boxes of side 1 of one mesh, each against every other, without a list.
Scene manyBoxes(std::size_t count, double cutoff) {
  Scene scene;
  scene.defaults.pairs.tracker.cutoff = cutoff;
  const SceneBody box = unitBox("box");
  for (std::size_t i = 0; i < count; ++i) {
    SceneBody body = box;
    body.name = body.frame = "b" + std::to_string(i);
    addBody(scene, body, {}, scene.defaults.pairs);
  }
  return scene;
}

Eigen::Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Bodies that wander in a cube; all turned alike, so that the distance of two is that of boxes.
struct Crowd {
  explicit Crowd(std::size_t count, double side, unsigned seed) : engine(seed) {
    for (std::size_t i = 0; i < count; ++i) {
      places.emplace_back(unit() * side, unit() * side, unit() * side);
    }
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine); }
  void wander(double most) {
    for (Eigen::Vector3d& place : places) {
      place += most * Eigen::Vector3d(2.0 * unit() - 1.0, 2.0 * unit() - 1.0, 2.0 * unit() - 1.0);
    }
  }
  Poses poses() const {
    Poses all;
    for (const Eigen::Vector3d& place : places) all.emplace_back(at(place.x(), place.y(), place.z()));
    return all;
  }
  double distance(std::size_t i, std::size_t j) const {
    return ((places[i] - places[j]).cwiseAbs() - Eigen::Vector3d::Ones()).cwiseMax(0.0).norm();
  }

  std::mt19937 engine;
  std::vector<Eigen::Vector3d> places;
};

TEST(NearPairs, AreTrackedAndTheOthersCountedWithABoundThatHolds) {
  constexpr double kCutoff = 0.4;
  const Scene scene = manyBoxes(40, kCutoff);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  Crowd crowd(40, 8.0, 1);
  std::set<std::size_t> counts;
  for (int step = 0; step < 60; ++step) {
    tracker.update(crowd.poses(), 0.02 * step, kDistance);
    std::map<std::pair<std::size_t, std::size_t>, const TrackedPair*> tracked;
    for (const auto& pair : tracker.pairs()) {
      tracked[std::minmax(pair->origin->body_a, pair->origin->body_b)] = pair.get();
    }
    EXPECT_EQ(tracked.size() + tracker.others().beyond, 40U * 39U / 2U);
    EXPECT_GE(tracker.others().lower_bound, kCutoff * (1.0 - 1e-12));
    for (std::size_t i = 0; i < 40; ++i) {
      for (std::size_t j = i + 1; j < 40; ++j) {
        const double distance = crowd.distance(i, j);
        const auto found = tracked.find({i, j});
        if (found == tracked.end()) {
          ASSERT_GT(distance, tracker.others().lower_bound);
        } else if (found->second->solved()) {
          ASSERT_NEAR(found->second->solution.distance, distance, 1e-9);
        } else {
          ASSERT_EQ(found->second->state, PairState::BeyondCutoff);
          ASSERT_GT(distance, kCutoff);
        }
      }
    }
    counts.insert(tracked.size());
    crowd.wander(0.1);
  }
  EXPECT_GT(counts.size(), 5U) << "pairs came and went";
  EXPECT_LT(*counts.rbegin(), 150U) << "of 780";
}

TEST(NearPairs, ComeBackWithTheirIdsSoonAndWithNewOnesLater) {
  const Scene scene = manyBoxes(2, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  double time = 0.0;
  const auto update = [&](double x, double seconds) {
    tracker.update({at(0.0), at(x)}, time += seconds, kNiches);
  };
  update(1.2, 0.02);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  ASSERT_FALSE(tracker.pairs()[0]->solution.niches.empty());
  const std::uint64_t id = tracker.pairs()[0]->solution.niches.front().id;
  update(9.0, 0.02);
  EXPECT_EQ(tracker.pairs()[0]->state, PairState::BeyondCutoff) << "there for one more cycle";
  update(9.0, 0.02);
  EXPECT_TRUE(tracker.pairs().empty());
  EXPECT_EQ(tracker.others().beyond, 1U);
  update(1.2, 1.0);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  EXPECT_EQ(tracker.pairs()[0]->solution.niches.front().id, id);
  EXPECT_TRUE(tracker.pairs()[0]->solution.warm);
  update(9.0, 0.02);
  update(9.0, 0.02);
  update(9.0, 5.0);
  update(1.2, 0.02);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  EXPECT_FALSE(tracker.pairs()[0]->solution.warm);
  EXPECT_GT(tracker.pairs()[0]->solution.niches.front().id, id) << "an id is never used again";
}

TEST(NearPairs, OfABodyWithoutAPoseAreKnownNotToBeKnown) {
  Scene scene = manyBoxes(3, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  EXPECT_EQ(tracker.update({at(0.0), at(1.2), std::nullopt}, 0.0, kDistance).not_located, 2U);
  ASSERT_EQ(tracker.pairs().size(), 3U);
  EXPECT_EQ(tracker.others().beyond, 0U);
  EXPECT_EQ(tracker.others().missing, 0U);
  EXPECT_EQ(tracker.update({at(0.0), at(1.2), at(9.0)}, 0.1, kDistance).not_located, 0U);
  tracker.update({at(0.0), at(1.2), at(9.0)}, 0.2, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 1U);
  EXPECT_EQ(tracker.others().beyond, 2U);
  Eigen::Isometry3d bad = at(0.0);
  bad.translation().x() = std::nan("");
  tracker.update({at(0.0), at(1.2), bad}, 0.3, kDistance);
  ASSERT_EQ(tracker.pairs().size(), 3U);
  EXPECT_EQ(tracker.pairs()[2]->solution.status, SolveStatus::InvalidPose);
}

TEST(NearPairs, WithoutAPoseAreCountedWhereThereAreMany) {
  const Scene scene = manyBoxes(60, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  tracker.update(Poses(60), 0.0, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 1000U);
  EXPECT_EQ(tracker.others().missing, 60U * 59U / 2U - 1000U);
  Crowd crowd(60, 1000.0, 3);
  tracker.update(crowd.poses(), 0.1, kDistance);
  tracker.update(crowd.poses(), 0.2, kDistance);
  EXPECT_EQ(tracker.pairs().size() + tracker.others().beyond, 60U * 59U / 2U);
  EXPECT_LT(tracker.pairs().size(), 10U);
  EXPECT_EQ(tracker.others().missing, 0U);
}

TEST(NearPairs, BeyondTheLimitAreCutWithABoundAndTheNearestComeFirst) {
  Scene scene = manyBoxes(6, 10.0);
  scene.limits.pairs = 4;
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  // 0 and 1 touch; the others stand in a row.
  const Poses poses = {at(0.0), at(1.0), at(3.0), at(5.0), at(7.0), at(9.0)};
  tracker.update(poses, 0.0, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 4U);
  EXPECT_EQ(tracker.others().cut, 11U);
  double nearest_cut = 1e9;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      const bool is_tracked =
          std::any_of(tracker.pairs().begin(), tracker.pairs().end(), [&](const auto& pair) {
            return std::minmax(pair->origin->body_a, pair->origin->body_b) == std::minmax(i, j);
          });
      const double distance = poses[j]->translation().x() - poses[i]->translation().x() - 1.0;
      if (!is_tracked) nearest_cut = std::min(nearest_cut, distance);
    }
  }
  EXPECT_LE(tracker.others().lower_bound, nearest_cut);
  scene.limits.pairs = 100;
  tracker.setScene(scene);
  tracker.update(poses, 0.1, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 15U);
  EXPECT_EQ(tracker.others().cut, 0U);
}

TEST(NearPairs, RaiseAndClearTheirAlerts) {
  Scene scene = manyBoxes(2, 0.5);
  scene.defaults.pairs.warning_distance = 0.3;
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  tracker.update({at(0.0), at(1.2)}, 0.0, kDistance);
  EXPECT_EQ(tracker.pairs()[0]->warning.state(), WarningState::Warning);
  tracker.update({at(0.0), at(50.0)}, 0.1, kDistance);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  EXPECT_EQ(tracker.pairs()[0]->warning.state(), WarningState::Clear);
  EXPECT_TRUE(tracker.pairs()[0]->warning_changed) << "seen before it leaves";
  tracker.update({at(0.0), at(1.2)}, 0.2, kDistance);
  removeBody(scene, "b1");
  tracker.setScene(scene, false);
  EXPECT_TRUE(tracker.pairs().empty());
  EXPECT_EQ(tracker.takeRetired().size(), 1U);
}

TEST(NearPairs, StayWarmThroughEditsOfOtherBodiesAndOfTheList) {
  Scene scene = manyBoxes(5, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  Poses poses = {at(-30.0), at(0.0), at(1.2), at(30.0), at(60.0)};
  tracker.update(poses, 0.0, kNiches);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  const std::uint64_t id = tracker.pairs()[0]->solution.niches.front().id;
  const auto expect_warm = [&](double time) {
    tracker.update(poses, time, kNiches);
    ASSERT_EQ(tracker.pairs().size(), 1U);
    EXPECT_EQ(tracker.pairs()[0]->solution.niches.front().id, id);
    EXPECT_TRUE(tracker.pairs()[0]->solution.warm);
  };
  removeBody(scene, "b0");  // the places of all others change
  tracker.setScene(scene, false);
  poses.erase(poses.begin());
  expect_warm(0.1);
  addBody(scene, manyBoxes(1, 0.5).bodies[0], {}, scene.defaults.pairs);
  tracker.setScene(scene, false);
  poses.push_back(at(90.0));
  expect_warm(0.2);
  setPairEnabled(scene, {"b2/b1", "", ""}, true, {});  // it is listed now
  ASSERT_EQ(scene.pairs.size(), 1U);
  tracker.setScene(scene, false);
  expect_warm(0.3);
  EXPECT_EQ(tracker.listedCount(), 1U);
  scene.bodies.edit(0).frame = "elsewhere";
  tracker.setScene(scene, false);
  expect_warm(0.4);
  poses = {at(0.0), at(90.0), at(60.0), at(0.0, 30.0), at(0.0, 60.0)};
  tracker.update(poses, 0.5, kNiches);
  ASSERT_EQ(tracker.pairs().size(), 1U) << "a listed pair is followed at any distance";
  EXPECT_EQ(tracker.pairs()[0]->state, PairState::BeyondCutoff);
}

TEST(NearPairs, FollowARuleThatChanges) {
  Scene scene = manyBoxes(3, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  const Poses poses = {at(0.0), at(1.2), at(2.4)};
  tracker.update(poses, 0.0, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 2U);
  setPairEnabled(scene, {"b1/*", "", ""}, false, {});
  tracker.setScene(scene, false);
  tracker.update(poses, 0.1, kDistance);
  EXPECT_TRUE(tracker.pairs().empty());
  EXPECT_EQ(tracker.others().beyond, 1U);
  setPairEnabled(scene, {"b1/*", "", ""}, true, {});
  tracker.setScene(scene, false);
  tracker.update(poses, 0.2, kDistance);
  EXPECT_EQ(tracker.pairs().size(), 2U);
}

// Poses of bodies may be of different times: they say which pairs are near, and Locate where each is solved.
TEST(NearPairs, AreSolvedWhereTheyAreLocated) {
  const Scene scene = manyBoxes(4, 0.5);
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  const Poses newest = {at(0.0), at(1.2), at(-1.3), at(90.0)};
  std::multiset<std::string> asked;
  const auto locate = [&](std::size_t a, std::size_t b) {
    const auto [first, last] = std::minmax(a, b);
    asked.insert(std::to_string(first) + std::to_string(last));
    PairInput input;
    input.located = last == 1;
    input.a_from_b = at(a == 0 ? 1.4 : -1.4);
    input.time = 7.0;
    return input;
  };
  const auto demand_of = [](std::size_t, const TrackedPair&) { return kDistance; };
  EXPECT_EQ(tracker.update(newest, 7.5, demand_of, locate).not_located, 1U);
  std::map<std::string, const TrackedPair*> pairs;
  for (const auto& pair : tracker.pairs()) pairs[pair->origin->name] = pair.get();
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs.at("b1/b0")->solution.distance, 0.4, 1e-12);
  EXPECT_EQ(pairs.at("b1/b0")->input.time, 7.0);
  EXPECT_EQ(pairs.at("b2/b0")->state, PairState::NotLocated);
  EXPECT_EQ(asked, (std::multiset<std::string>{"01", "02"})) << "each near pair once, and no other";
  EXPECT_EQ(tracker.update(newest, 7.6, demand_of, locate).repeated, 1U);
}

// Where the world's origin is 1e9 m away, poses have lost their last seven digits: the bound has too.
TEST(NearPairs, BeyondTheLimitHaveABoundThatHoldsFarFromTheOrigin) {
  Scene scene = manyBoxes(3, 10.0);
  scene.limits.pairs = 1;
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  Poses poses;
  for (const double x : {0.0, 2.0, 4.0}) {
    poses.emplace_back(Eigen::Translation3d(1e9, 1e9, 1e9) * turn * Eigen::Translation3d(x, 0.0, 0.0));
  }
  tracker.update(poses, 0.0, kDistance);
  EXPECT_EQ(tracker.others().cut, 2U);
  EXPECT_LT(tracker.others().lower_bound, 1.0 - 1e-7);
  EXPECT_GT(tracker.others().lower_bound, 1.0 - 1e-4);
}

}  // namespace
}  // namespace concave_distance::near_pairs_test
