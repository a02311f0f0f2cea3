// SceneTracker::prepare(): the first cycle finds ready what later ones find.
#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/search/prepare_search.h"
#include "support/box_scene.h"
#include "support/count_allocations.h"
#include "support/random_solids.h"

namespace concave_distance::prepare_scene_test {
namespace {

using Poses = std::vector<std::optional<Eigen::Isometry3d>>;

Eigen::Isometry3d at(double x, double y = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.0) *
                           Eigen::AngleAxisd(0.1 * x, Eigen::Vector3d::UnitZ()));
}

void addBall(Scene& scene, const std::string& name, double sag) {
  SceneBody body;
  body.name = body.frame = name;
  body.serial = newBodySerial();
  body.mesh = std::make_shared<const BodyMesh>(name, test::makeBumpyBall(1.0, sag, 5.0));
  body.bounds = boundsOf(*body.mesh);
  scene.bodies.push_back(body);
}

void addPair(Scene& scene, std::size_t a, std::size_t b) {
  ScenePair pair;
  pair.name = scene.bodies[a].name + "/" + scene.bodies[b].name;
  pair.body_a = a;
  pair.body_b = b;
  scene.pairs.push_back(pair);
}

/// Two bumpy balls, with hundreds of niches, and a box.
Scene bumpyScene() {
  Scene scene;
  addBall(scene, "a", 1e-2);
  addBall(scene, "b", 1.2e-2);
  scene.bodies.push_back(unitBox("box"));
  scene.bodies.edit(2).serial = newBodySerial();
  addPair(scene, 0, 1);
  addPair(scene, 1, 2);
  return scene;
}

Poses posesAt(double time) {
  return {at(0.0), at(2.5 - 0.1 * time, 0.05 * time), at(-3.0)};
}

class PrepareSceneTest : public ::testing::TestWithParam<bool> {
 protected:
  SceneTracker tracker{{1, nullptr, GetParam()}};
  Scene scene = bumpyScene();
};

TEST_P(PrepareSceneTest, TheFirstCycleMakesAndAllocatesNothing) {
  tracker.setScene(scene);
  const PreparationCounts counts = tracker.prepare(posesAt(0.0), 0.0);
  EXPECT_TRUE(counts.isComplete());
  EXPECT_EQ(counts.bodies, 3U);
  std::vector<Poses> poses;
  for (int k = 1; k <= 50; ++k) poses.push_back(posesAt(1e-3 * k));
  for (int k = 1; k <= 50; ++k) {
    const std::size_t before = allocations;
    const CycleCounts cycle = tracker.update(poses[static_cast<std::size_t>(k) - 1], 1e-3 * k);
    EXPECT_EQ(allocations, before) << "cycle " << k;
    EXPECT_EQ(cycle.cold, 0U);
    EXPECT_EQ(cycle.unprepared, 0U);
    EXPECT_EQ(cycle.solved, 2U);
    for (const auto& pair : tracker.pairs()) {
      EXPECT_TRUE(pair->solution.niches_complete);
      EXPECT_TRUE(pair->solution.events.empty() || k > 1);
    }
  }
}

TEST_P(PrepareSceneTest, TheFirstCycleWithAnEndAllocatesNothingEither) {
  tracker.setScene(scene);
  tracker.prepare(posesAt(0.0), 0.0);
  const Poses next = posesAt(1e-3);
  const std::size_t before = allocations;
  const auto end = WorkLimit::Clock::now() + std::chrono::seconds(100);
  tracker.update(next, 1e-3, {true, true, true, false}, end);
  EXPECT_EQ(allocations, before);
}

TEST_P(PrepareSceneTest, GivesTheNichesOfATrackerThatHasNotBeenPrepared) {
  tracker.setScene(scene);
  tracker.prepare(posesAt(0.0), 0.0);
  SceneTracker other({1, nullptr});
  other.setScene(bumpyScene());
  for (const double time : {0.01, 0.02}) {
    tracker.update(posesAt(time), time);
    other.update(posesAt(time), time);
    for (std::size_t i = 0; i < 2; ++i) {
      const PairSolution& found = tracker.pairs()[i]->solution;
      const PairSolution& expected = other.pairs()[i]->solution;
      EXPECT_EQ(found.distance, expected.distance);
      ASSERT_EQ(found.niches.size(), expected.niches.size());
      for (std::size_t k = 0; k < found.niches.size(); ++k)
        EXPECT_NEAR(found.niches[k].distance, expected.niches[k].distance, 1e-12);
    }
  }
}

// Grids are not made for two convex bodies, nor without niches.
TEST_P(PrepareSceneTest, MakesWhatTheCyclesNeedAndNoMore) {
  Scene boxes = threeBoxes();
  tracker.setScene(boxes);
  tracker.prepare({at(0.0), at(2.0), at(-3.0)}, 0.0);
  for (const SceneBody& body : boxes.bodies)
    EXPECT_EQ(searchPreparationOf(body.mesh->asSolved()).grid_nodes, 0U);
  SceneTracker alone({1, nullptr});
  alone.setScene(scene);
  const PreparationCounts counts = alone.prepare(posesAt(0.0), 0.0, {true, true, false, false});
  EXPECT_EQ(counts.bodies, 0U);
  for (const SceneBody& body : scene.bodies)
    EXPECT_EQ(searchPreparationOf(body.mesh->asSolved()).grid_nodes, 0U);
  EXPECT_EQ(alone.update(posesAt(0.1), 0.1, {true, true, false, false}).cold, 0U);
}

TEST_P(PrepareSceneTest, AfterAnEditItMakesOnlyTheNewAndLeavesTheOthersAsTheyAre) {
  tracker.setScene(scene);
  tracker.prepare(posesAt(0.0), 0.0);
  tracker.update(posesAt(0.01), 0.01);
  const std::vector<TrackedNiche> before = tracker.pairs()[0]->solution.niches;
  const BodyAttachment* const grid = scene.bodies[0].mesh->asSolved().attachment();
  addBall(scene, "late", 1.5e-2);
  addPair(scene, 0, 3);
  tracker.setScene(scene);
  Poses poses = posesAt(0.01);
  poses.emplace_back(at(0.0, 2.6));
  const PreparationCounts counts = tracker.prepare(poses, 0.01);
  EXPECT_TRUE(counts.isComplete());
  EXPECT_EQ(scene.bodies[0].mesh->asSolved().attachment(), grid);
  EXPECT_NE(searchPreparationOf(scene.bodies[3].mesh->asSolved()).grid_nodes, 0U);
  ASSERT_EQ(tracker.pairs()[0]->solution.niches.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(tracker.pairs()[0]->solution.niches[k].id, before[k].id);
    EXPECT_EQ(tracker.pairs()[0]->solution.niches[k].distance, before[k].distance);
  }
  poses = posesAt(0.02);
  poses.emplace_back(at(0.0, 2.6));
  const std::size_t count = allocations;
  const CycleCounts cycle = tracker.update(poses, 0.02);
  EXPECT_EQ(allocations, count);
  EXPECT_EQ(cycle.cold, 0U);
  EXPECT_EQ(cycle.solved, 3U);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutABackground, PrepareSceneTest, ::testing::Bool());

TEST(PrepareScene, WithoutTimeItLeavesEverythingToTheCycles) {
  const Scene scene = bumpyScene();
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  PreparationSettings settings;
  settings.time_limit = 0.0;
  const PreparationCounts counts = tracker.prepare(posesAt(0.0), 0.0, {true, true, true, false}, settings);
  EXPECT_EQ(counts.left, 3U);
  EXPECT_FALSE(counts.isComplete());
  tracker.update(posesAt(0.1), 0.1);
  EXPECT_TRUE(tracker.pairs()[0]->solution.niches_complete);
  EXPECT_GT(tracker.pairs()[0]->solution.cost.generations, 0U) << "its search is made";
}

TEST(PrepareScene, ReportsItsProgressToTheEnd) {
  SceneTracker tracker({1, nullptr});
  tracker.setScene(bumpyScene());
  std::vector<std::size_t> seen;
  std::size_t total = 0;
  PreparationSettings settings;
  settings.progress = [&](std::size_t done, std::size_t count) {
    seen.push_back(done);
    total = count;
  };
  tracker.prepare(posesAt(0.0), 0.0, {true, true, true, false}, settings);
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), total);
}

TEST(PrepareScene, RaisesNoAlertByItself) {
  Scene scene = threeBoxes();
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) scene.pairs.edit(i).settings.warning_distance = 1.5;
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  tracker.prepare({at(0.0), at(2.0), at(-3.0)}, 0.0);
  EXPECT_EQ(tracker.pairs()[0]->warning.state(), WarningState::Clear);
  tracker.update({at(0.0), at(2.0), at(-3.0)}, 0.1);
  EXPECT_TRUE(tracker.pairs()[0]->warning_changed);
  EXPECT_NE(tracker.pairs()[0]->warning.state(), WarningState::Clear);
}

// A body that rules watch is far away at first.
TEST(PrepareScene, MakesOfBodiesThatMayComeNearWhatTheyNeed) {
  Scene scene = bumpyScene();
  scene.pairs = {};
  PairRule everything;
  everything.earlier = everything.later = BodySet::before(scene.bodies.size());
  everything.watch(PairOrder::Later);
  scene.rules.list = {everything};
  scene.defaults.pairs.tracker.cutoff = 1.0;
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  const auto poses = [](double x) { return Poses{at(0.0), at(x), at(-90.0)}; };
  EXPECT_EQ(tracker.prepare(poses(50.0), 0.0).bodies, 3U);
  ASSERT_TRUE(tracker.pairs().empty());
  EXPECT_EQ(tracker.update(poses(2.5), 0.1).unprepared, 0U);
  ASSERT_EQ(tracker.pairs().size(), 1U);
  EXPECT_FALSE(tracker.pairs()[0]->solution.niches.empty());
}

TEST(PrepareScene, RefusesAnotherNumberOfPoses) {
  SceneTracker tracker({1, nullptr});
  tracker.setScene(threeBoxes());
  EXPECT_THROW(tracker.prepare({at(0.0)}, 0.0), Error);
}

}  // namespace
}  // namespace concave_distance::prepare_scene_test
