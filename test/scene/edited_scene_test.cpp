// A scene that batches of operations edited step by step answers as one that knows nothing of the steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/random_engine.h"
#include "concave_distance/scene/scene_tracker.h"
#include "operations_fixture.h"
#include "scene/rule_edits.h"
#include "support/body_motions.h"
#include "support/scene_fixture.h"

namespace concave_distance::edited_scene_test {
namespace {

using Eigen::Isometry3d;
using namespace detail;
using namespace test::operations;

/// Keeps, apart from the scene, where the bodies are and what moves them.
class Model {
 public:
  struct Known {
    Isometry3d world_from_body = at(0);
    std::string mover;   ///< a frame of tf, or itself
    std::string parent;  ///< empty: it is not attached
    Isometry3d parent_from_body = at(0);
    std::string mover_before;
    std::set<std::string> touch;
  };
  std::map<std::string, Known> bodies;

  bool hangsOn(std::string name, const std::string& ancestor) const {
    while (!name.empty() && name != ancestor) name = bodies.at(name).parent;
    return !name.empty();
  }
  void moved(const std::string& name, const Isometry3d& pose) {
    bodies[name].world_from_body = pose;
    follow(name);
  }
  void follow(const std::string& parent) {
    for (auto& [name, known] : bodies) {
      if (known.parent != parent) continue;
      known.world_from_body = bodies[parent].world_from_body * known.parent_from_body;
      known.mover = bodies[parent].mover;
      follow(name);
    }
  }
  bool isWatched(const std::string& a, const std::string& b) const {
    const Known& l = bodies.at(a);
    const Known& r = bodies.at(b);
    return l.mover != r.mover && l.touch.count(b) == 0 && r.touch.count(a) == 0;
  }
};

/// A scene that is edited at random while a tracker follows it.
class EditedScene {
 public:
  explicit EditedScene(std::uint64_t seed) : engine_(seed), scene_(cell()), tracker_({1, nullptr}) {
    for (const SceneBody& each : scene_.bodies) {
      model_.bodies[each.name] = {
          frames_.world_from[each.frame] * each.frame_from_body, each.frame, "", at(0), "", {}};
    }
    for (const char* link : {"hand", "arm"}) motions_[link] = test::randomMotion(engine_);
    tracker_.setScene(scene_);
  }

  void step() {
    time_ += 0.05;
    for (auto& [link, motion] : motions_) {
      frames_.world_from[link] = at(0, 0, link == "arm" ? 3.0 : 0.0) * motion.at(time_);
      model_.moved(link, frames_.world_from[link]);
    }
    cycle();
    const std::map<std::string, Seen> before = seen();
    const bool stands = edit();
    tracker_.setScene(scene_, false);
    time_ += 0.001;
    cycle();
    compare();
    for (const auto& [name, now] : seen()) {
      const auto old = before.find(name);
      if (old == before.end()) continue;
      ASSERT_EQ(now.pair, old->second.pair) << name << " is tracked on";
      ASSERT_EQ(now.tracker, old->second.tracker) << name;
      if (stands) {
        ASSERT_EQ(now.ids, old->second.ids) << name << ": nothing has moved";
      }
      ++kept;
    }
  }

  int kept = 0;      ///< pairs that an edit has left in the scene
  int attached = 0;  ///< operations
  int detached = 0;

 private:
  struct Seen {
    const TrackedPair* pair = nullptr;
    const PairTracker* tracker = nullptr;
    std::vector<std::uint64_t> ids;
  };

  Isometry3d randomPose() { return test::randomMotion(engine_).at(1.0); }
  std::string anyBody() { return scene_.bodies[engine_() % scene_.bodies.size()].name; }

  /// @return true when no body changes its place
  bool edit() {
    const std::string name = anyBody();
    Model::Known& known = model_.bodies[name];
    const bool is_link = motions_.count(name) != 0;
    const auto kind = engine_() % 5;
    if (kind == 0 && scene_.bodies.size() < 8) {
      const std::string added = "b" + std::to_string(++added_);
      const Isometry3d pose = randomPose();
      runAll({add(body(added, "world", pose))});
      model_.bodies[added] = {pose, "world", "", at(0), "", {}};
      return true;
    }
    if (is_link) return true;
    if (kind == 1 && scene_.bodies.size() > 4) {
      for (const auto& [other, its] : model_.bodies) {
        if (its.parent == name) return true;
      }
      runAll({operation(OperationKind::Remove, name)});
      model_.bodies.erase(name);
      return true;
    }
    if (!known.parent.empty()) {
      runAll({detach(name)});
      ++detached;
      known.parent.clear();
      known.touch.clear();
      known.mover = known.mover_before;
      model_.follow(name);
      return true;
    }
    const std::string parent = anyBody();
    if (kind == 2 || model_.hangsOn(parent, name)) {
      const Isometry3d pose = randomPose();
      runAll({move(name, pose, "world")});
      known.mover = name;
      model_.moved(name, pose);
      return false;
    }
    const std::string touched = anyBody();
    runAll({attach(name, parent, {touched})});
    ++attached;
    known.parent = parent;
    known.parent_from_body = model_.bodies[parent].world_from_body.inverse() * known.world_from_body;
    known.mover_before = known.mover;
    known.mover = model_.bodies[parent].mover;
    known.touch = {touched};
    model_.follow(name);
    return true;
  }

  void runAll(const std::vector<SceneOperation>& operations) {
    std::map<std::string, std::pair<std::uint64_t, const BodyMesh*>> before;
    for (const SceneBody& each : scene_.bodies) before[each.name] = {each.serial, each.mesh.get()};
    const AppliedOperations applied = applyOperations(scene_, operations, frames_.now());
    for (const OperationFault& fault : applied.faults) ADD_FAILURE() << fault.error.what();
    for (const SceneBody& each : scene_.bodies) {
      if (before.count(each.name) == 0) continue;
      EXPECT_EQ(before[each.name], std::pair(each.serial, each.mesh.get())) << each.name;
    }
  }

  void cycle() { tracker_.update(posesOf(scene_, frames_), time_); }

  std::map<std::string, Seen> seen() const {
    std::map<std::string, Seen> all;
    for (const auto& pair : tracker_.pairs()) {
      Seen& one = all[pair->origin->name];
      one.pair = pair.get();
      one.tracker = pair->tracker();
      for (const TrackedNiche& niche : pair->solution.niches) one.ids.push_back(niche.id);
      std::sort(one.ids.begin(), one.ids.end());
    }
    return all;
  }

  /// Every pair of bodies, solved from nothing at the poses that the model knows.
  void compare() {
    std::map<std::pair<std::size_t, std::size_t>, const TrackedPair*> tracked;
    for (const auto& pair : tracker_.pairs()) {
      tracked[std::minmax(pair->origin->body_a, pair->origin->body_b)] = pair.get();
    }
    ASSERT_EQ(countPairsByRule(scene_), tracked.size());
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < scene_.bodies.size(); ++j) {
        const std::string& a = scene_.bodies[i].name;
        const std::string& b = scene_.bodies[j].name;
        const auto found = tracked.find({i, j});
        ASSERT_EQ(found != tracked.end(), model_.isWatched(a, b)) << a << " and " << b;
        if (found == tracked.end()) continue;
        compare(*found->second);
      }
    }
  }
  void compare(const TrackedPair& pair) {
    const Isometry3d& a = model_.bodies.at(pair.body_a->name).world_from_body;
    const Isometry3d& b = model_.bodies.at(pair.body_b->name).world_from_body;
    TrackerParameters parameters = pair.settings.tracker;
    parameters.niches_wanted = true;
    const PairSolution fresh =
        solveOnce("fresh", pair.body_a->mesh, pair.body_b->mesh, parameters, a.inverse() * b);
    ASSERT_TRUE(pair.solved());
    ASSERT_NEAR(pair.solution.distance, fresh.distance, 1e-9) << pair.origin->name;
    if (!pair.solution.niches_complete || !fresh.niches_complete) return;
    ASSERT_EQ(distancesOf(pair.solution).size(), distancesOf(fresh).size()) << pair.origin->name;
    for (std::size_t i = 0; i < fresh.niches.size(); ++i) {
      ASSERT_NEAR(distancesOf(pair.solution)[i], distancesOf(fresh)[i], 1e-9) << pair.origin->name;
    }
  }
  static std::vector<double> distancesOf(const PairSolution& solution) {
    std::vector<double> distances;
    for (const TrackedNiche& niche : solution.niches) distances.push_back(niche.distance);
    std::sort(distances.begin(), distances.end());
    return distances;
  }

  RandomEngine engine_;
  Frames frames_;
  Scene scene_;
  SceneTracker tracker_;
  Model model_;
  std::map<std::string, test::Motion> motions_;
  double time_ = 0.0;
  int added_ = 0;
};

TEST(EditedScene, AnswersAsAFreshOneAndKeepsMeshesTrackersAndIds) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    EditedScene scene(seed);
    for (int step = 0; step < 150 && !::testing::Test::HasFatalFailure(); ++step) scene.step();
    EXPECT_GT(scene.kept, 500);
    EXPECT_GT(scene.attached, 10);
    EXPECT_GT(scene.detached, 10);
  }
}

TEST(EditedScene, TakesAHundredBodiesOfOneMeshInABatch) {
  Scene scene = cell();
  std::vector<SceneOperation> operations;
  for (int i = 0; i < 100; ++i)
    operations.push_back(add(body("c" + std::to_string(i), "world", at(0, 2.0 * i))));
  ASSERT_TRUE(run(scene, operations).faults.empty());
  EXPECT_EQ(scene.bodies.size(), 105U);
  EXPECT_EQ(countPairsByRule(scene), 2U * 103U + 1U) << "each against the two links, and these";
}

}  // namespace
}  // namespace concave_distance::edited_scene_test
