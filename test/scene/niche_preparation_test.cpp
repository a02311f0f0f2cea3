// A scene prepares in the background what niches need of the bodies.
#include "scene/niche_preparation.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <thread>

#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/search/prepare_search.h"
#include "mesh/trees/normal_cone_tree.h"
#include "scene/body_preparation.h"
#include "support/box_scene.h"
#include "support/count_allocations.h"
#include "support/random_solids.h"

namespace concave_distance::niche_preparation_test {
namespace {

using Poses = std::vector<std::optional<Eigen::Isometry3d>>;

Eigen::Isometry3d at(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

SceneBody bumpyBody(const std::string& name, double sag) {
  SceneBody body;
  body.name = body.frame = name;
  body.mesh = std::make_shared<const BodyMesh>(name, test::makeBumpyBall(1.0, sag, 5.0));
  body.bounds = boundsOf(*body.mesh);
  return body;
}

/// Two bodies that take tens of milliseconds to prepare.
Scene twoBumpyBalls() {
  Scene scene;
  scene.bodies.push_back(bumpyBody("a", 1e-3));
  scene.bodies.push_back(bumpyBody("b", 1.2e-3));
  ScenePair pair;
  pair.name = "a/b";
  pair.body_a = 0;
  pair.body_b = 1;
  scene.pairs.push_back(pair);
  return scene;
}

Poses posesAt(double time) {
  return {at(0.0), at(2.5 - 0.1 * time)};
}

TEST(NichePreparation, UntilItIsDoneACycleGivesTheDistanceAlone) {
  const Scene scene = twoBumpyBalls();
  SceneTracker tracker({1, nullptr, true});
  tracker.setScene(scene);
  const TrackedPair& pair = *tracker.pairs()[0];
  PairTracker alone("a/b", scene.bodies[0].mesh, scene.bodies[1].mesh, [] {
    TrackerParameters parameters;
    parameters.niches_wanted = false;
    return parameters;
  }());
  PairSolution expected;
  int waited = 0;
  double time = 0.0;
  while (tracker.update(posesAt(time), time).unprepared == 1) {
    ++waited;
    EXPECT_FALSE(pair.demand.niches);
    EXPECT_FALSE(pair.solution.niches_complete);
    EXPECT_TRUE(pair.solution.niches.empty());
    EXPECT_EQ(pair.solution.status, SolveStatus::Ok);
    alone.update(*posesAt(time)[1], time, expected);
    EXPECT_EQ(pair.solution.distance, expected.distance);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    time += 1e-4;
    ASSERT_LT(waited, 60'000);
  }
  EXPECT_GT(waited, 0);
  EXPECT_TRUE(pair.solution.niches_complete);
  const PairSolution once =
      solveOnce("a/b", scene.bodies[0].mesh, scene.bodies[1].mesh, pair.settings.tracker, *posesAt(time)[1]);
  ASSERT_EQ(pair.solution.niches.size(), once.niches.size());
  for (std::size_t k = 0; k < once.niches.size(); ++k) {
    EXPECT_EQ(pair.solution.niches[k].distance, once.niches[k].distance);
  }
}

TEST(NichePreparation, ItBeginsWithTheSceneAndNotWithTheFirstDemand) {
  const Scene scene = twoBumpyBalls();
  SceneTracker tracker({1, nullptr, true});
  tracker.setScene(scene);
  const TrackedPair& pair = *tracker.pairs()[0];
  ASSERT_TRUE(pair.preparation);
  for (int k = 0; !pair.preparation->isDone() && k < 60'000; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).unprepared, 0U);
  EXPECT_TRUE(pair.solution.niches_complete);
}

// Grids take ten times as long as normal cones, without which nothing is proven.
TEST(NichePreparation, ListsAreCompleteBeforeTheSearchIsMadeWhichJoinsLater) {
  const Scene scene = twoBumpyBalls();
  SceneTracker tracker({1, nullptr, false});
  tracker.setScene(scene);
  TrackedPair& pair = *tracker.pairs()[0];
  pair.preparation =
      std::make_shared<PreparationTask>(pair.body_a->mesh, pair.body_b->mesh, pair.settings.tracker);
  pair.preparation->makeNiches();
  for (const double time : {0.0, 0.1}) tracker.update(posesAt(time), time);
  EXPECT_TRUE(pair.solution.niches_complete);
  EXPECT_EQ(pair.solution.cost.generations, 0U);
  EXPECT_EQ(searchPreparationOf(pair.body_a->mesh->asSolved()).grid_nodes, 0U) << "no cycle makes it";
  const std::size_t niches = pair.solution.niches.size();
  pair.preparation->makeSearch();
  tracker.update(posesAt(0.2), 0.2);
  EXPECT_EQ(pair.solution.cost.generations, 1U);
  EXPECT_TRUE(pair.solution.niches_complete);
  EXPECT_EQ(pair.solution.niches.size(), niches);
}

// The surface of a cloud is replaced some times a second, sooner than a grid pays for itself.
TEST(NichePreparation, TheSearchIsMadeOfWhatHasLastedForASecond) {
  const auto begin = std::chrono::steady_clock::now();
  SceneTracker tracker({1, nullptr, true});
  tracker.setScene(twoBumpyBalls());
  const TrackedPair& pair = *tracker.pairs()[0];
  ASSERT_TRUE(pair.preparation);
  for (int k = 0; !pair.preparation->isSearchDone() && k < 60'000; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(pair.preparation->isSearchDone());
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

// The process ends with the number of its threads after a preparation in the background.
[[noreturn]] void prepareAndExit() {
  tbb::task_arena alone(1);
  std::optional<Scene> scene;
  alone.execute([&] { scene = twoBumpyBalls(); });
  SceneTracker tracker({1, nullptr, true});
  alone.execute([&] { tracker.setScene(*scene); });
  while (!tracker.pairs()[0]->preparation->isSearchDone())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::filesystem::directory_iterator threads("/proc/self/task");
  std::_Exit(static_cast<int>(std::distance(begin(threads), end(threads))));
}

// Workers have the priority of the thread that begins them: one of the background's would hold up cycles.
TEST(NichePreparation, ItBeginsNoWorker) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(prepareAndExit(), ::testing::ExitedWithCode(2), "");
}

TEST(NichePreparation, ItKeepsNoMeshThatIsGoneAndMakesNothingForAPairThatIs) {
  SceneTracker tracker({1, nullptr, true});
  std::vector<std::weak_ptr<const BodyMesh>> meshes;
  for (int k = 0; k < 20; ++k) {
    const Scene scene = twoBumpyBalls();
    meshes.emplace_back(scene.bodies[0].mesh);
    tracker.setScene(scene);
  }
  tracker.setScene(Scene());
  // One of them may be in work.
  const auto alive =
      std::count_if(meshes.begin(), meshes.end(), [](const auto& mesh) { return !mesh.expired(); });
  EXPECT_LE(alive, 1);
}

TEST(NichePreparation, WithoutItTheFirstCycleWaits) {
  SceneTracker tracker({1, nullptr, false});
  tracker.setScene(twoBumpyBalls());
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).unprepared, 0U);
  EXPECT_TRUE(tracker.pairs()[0]->solution.niches_complete);
}

TEST(NichePreparation, ABodyMayGoWhileItIsPrepared) {
  std::weak_ptr<const BodyMesh> gone;
  {
    SceneTracker tracker({1, nullptr, true});
    {
      const Scene scene = twoBumpyBalls();
      gone = scene.bodies[0].mesh;
      tracker.setScene(scene);
      tracker.update(posesAt(0.0), 0.0);
    }
    tracker.setScene(Scene());
    EXPECT_EQ(tracker.update(Poses(), 0.1).watched, 0U);
    tracker.setScene(threeBoxes());
    EXPECT_EQ(tracker.update({at(0.0), at(2.0), at(-3.0)}, 0.2).solved, 2U);
  }
  EXPECT_TRUE(gone.expired());
}

TEST(NichePreparation, OtherSettingsNeedMoreOnlyWhereTheySayMore) {
  const Scene scene = threeBoxes();
  TrackerParameters parameters;
  const PreparationTask task(scene.bodies[0].mesh, scene.bodies[1].mesh, parameters);
  parameters.cutoff = 1.0;
  EXPECT_TRUE(task.suffices(parameters));
  parameters.hidden = true;
  EXPECT_FALSE(task.suffices(parameters));
  parameters.hidden = false;
  parameters.keep_through_material = true;
  EXPECT_FALSE(task.suffices(parameters));
}

TEST(NichePreparation, ConvexBodiesNeedNoNormalCones) {
  const Scene boxes = threeBoxes();
  PreparationTask task(boxes.bodies[0].mesh, boxes.bodies[1].mesh, TrackerParameters());
  task.run();
  EXPECT_TRUE(task.isDone());
  const std::size_t before = allocations;
  makeCommonParts(*boxes.bodies[0].mesh);
  EXPECT_EQ(allocations, before) << "it has made them";
  boxes.bodies[0].mesh->prepareNiches(NormalSides::Outside);
  EXPECT_GT(allocations, before) << "and no normal cones";
}

}  // namespace
}  // namespace concave_distance::niche_preparation_test
