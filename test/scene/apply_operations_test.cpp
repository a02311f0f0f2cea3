// Batches of operations on a scene: what is refused, and that a scene that was edited step by step answers as
// one that knows nothing of the steps.
#include "scene/apply_operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/random_engine.h"
#include "concave_distance/scene/scene_tracker.h"
#include "scene/rule_edits.h"
#include "scene/scene_edits.h"
#include "support/body_motions.h"
#include "support/box_scene.h"
#include "support/scene_fixture.h"

namespace concave_distance::apply_operations_test {
namespace {

using Eigen::Isometry3d;
using namespace detail;
using test::mentions;
using Names = std::vector<std::string>;

Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Frames of tf by their poses in the world.
struct Frames {
  std::map<std::string, Isometry3d> world_from{
      {"world", at(0)}, {"hand", at(0, 0, 5)}, {"arm", at(0, 0, 9)}, {"bench", at(9)}};
  std::set<std::string> moving{"hand", "arm"};

  FramesNow now() const {
    return {"world", [this](const std::string& target, const std::string& source) {
              std::optional<FrameRelation> relation;
              if (world_from.count(target) == 0 || world_from.count(source) == 0) return relation;
              relation.emplace();
              relation->target_from_source = world_from.at(target).inverse() * world_from.at(source);
              relation->is_fixed = moving.count(target) == 0 && moving.count(source) == 0;
              return relation;
            }};
  }
};

SceneBody body(const std::string& name, const std::string& frame, const Isometry3d& pose = at(0)) {
  static const SceneBody kBox = unitBox("box");
  SceneBody result = kBox;
  result.name = name;
  result.frame = frame;
  result.frame_from_body = pose;
  return result;
}

/// Two links of a robot, a table and two boxes.
Scene cell() {
  Scene scene;
  scene.defaults.pairs.tracker.cold.population_size = 40;
  for (const char* link : {"hand", "arm"}) {
    SceneBody added = body(link, link);
    added.is_robot_link = true;
    addBody(scene, added, {}, scene.defaults.pairs);
  }
  for (const auto& [name, x] : {std::pair("table", 0.0), std::pair("box", 3.0), std::pair("peg", 6.0)}) {
    addBody(scene, body(name, "world", at(x)), {}, scene.defaults.pairs);
  }
  scene.groups["gripper"] = {"hand"};
  return scene;
}

SceneOperation operation(OperationKind kind, const std::string& name, const std::string& other = "") {
  SceneOperation result;
  result.kind = kind;
  result.body = name;
  result.other = other;
  return result;
}
SceneOperation add(const SceneBody& added) {
  SceneOperation result = operation(OperationKind::Add, added.name);
  result.added = added;
  return result;
}
SceneOperation move(const std::string& name, const Isometry3d& pose, const std::string& frame = "") {
  SceneOperation result = operation(OperationKind::Move, name);
  result.frame_from_body = pose;
  result.frame = frame;
  return result;
}
SceneOperation attach(const std::string& name, const std::string& parent, const Names& touch = {}) {
  SceneOperation result = operation(OperationKind::Attach, name, parent);
  result.touch_links = touch;
  return result;
}
SceneOperation detach(const std::string& name, const std::string& frame = "") {
  SceneOperation result = operation(OperationKind::Detach, name);
  result.frame = frame;
  return result;
}
SceneOperation margin(const std::string& name, double metres) {
  SceneOperation result = operation(OperationKind::SetMargin, name);
  result.margin = metres;
  return result;
}

AppliedOperations run(Scene& scene, const std::vector<SceneOperation>& operations,
                      const Frames& frames = {}) {
  return applyOperations(scene, operations, frames.now());
}

/// The message of the only fault, that of the last operation.
std::string refusal(const std::vector<SceneOperation>& operations) {
  Scene scene = cell();
  const AppliedOperations applied = run(scene, operations);
  if (applied.faults.size() != 1) return std::to_string(applied.faults.size()) + " faults";
  EXPECT_EQ(applied.faults[0].operation, operations.size() - 1);
  return applied.faults[0].error.what();
}

bool watches(const Scene& scene, const std::string& a, const std::string& b) {
  const auto pair = pairOf(scene, *scene.findBody(a), *scene.findBody(b));
  return pair && pair->enabled;
}

TEST(ApplyOperations, NamesEachFault) {
  const auto expect = [](const std::vector<SceneOperation>& operations, const Names& parts) {
    const std::string message = refusal(operations);
    for (const std::string& part : parts) EXPECT_TRUE(mentions(message, part)) << part << " in: " << message;
  };
  expect({add(body("box", "world"))}, {"there is a body 'box' already"});
  expect({add(body("gripper", "world"))}, {"there is a group 'gripper'", "another name"});
  expect({add(body("a box", "world"))}, {"'a box'", "topic name"});
  expect({move("cup", at(0))}, {"there is no body 'cup'"});
  expect({move("hand", at(0))}, {"body 'hand'", "link of a robot", "tf moves"});
  expect({attach("hand", "arm")}, {"body 'hand'", "link of a robot"});
  expect({detach("hand")}, {"body 'hand'", "link of a robot"});
  expect({move("box", at(std::nan("")))}, {"body 'box'", "not finite"});
  expect({move("box", at(0), "moon")}, {"does not connect 'moon' and 'world'"});
  expect({attach("box", "hand"), move("box", at(0))}, {"attached to 'hand'", "detach it first"});
  expect({attach("box", "hand"), attach("box", "arm")}, {"attached to 'hand' already", "detach it first"});
  expect({attach("box", "elbow")}, {"neither a body nor a tf frame 'elbow'"});
  expect({attach("box", "")}, {"neither a body nor a tf frame ''"});
  expect({attach("box", "gripper")}, {"'gripper' is a group"});
  expect({attach("box", "box")}, {"attached to itself"});
  expect({attach("box", "peg"), attach("table", "box"), attach("peg", "table")}, {"body 'peg'", "a cycle"});
  expect({detach("box")}, {"body 'box'", "not attached"});
  expect({attach("box", "hand"), detach("box", "moon")}, {"no transform from 'hand' to 'moon'"});
  expect({attach("peg", "box"), operation(OperationKind::Remove, "box")},
         {"'peg' is attached to 'box'", "detach or remove it first"});
  expect({operation(OperationKind::Remove, "cup")}, {"there is no body 'cup'"});
  expect({operation(OperationKind::Remove, "arm")}, {"'arm' is a link of a robot"});
  expect({operation(OperationKind::AllowContact, "box", "cup")}, {"body_b", "there is no body 'cup'"});
  expect({operation(OperationKind::AllowContact, "box", "box")}, {"both bodies are 'box'"});
  expect({margin("box", -0.1)}, {"margin", "-0.1", "metres"});
  expect({margin("box", std::nan(""))}, {"margin", "nan"});
  expect({margin("box", 1000.0)}, {"body 'box'"});
  expect({margin("cu*", 0.1)}, {"'cu*' matches no body"});
  expect({add(body("tray", "arm")), move("tray", at(0))}, {"tf moves its frame 'arm'"});
}

TEST(ApplyOperations, RefusesAWarningBeyondTheCutoff) {
  Scene scene = cell();
  scene.defaults.pairs.tracker.cutoff = 0.5;
  SceneOperation added = add(body("tray", "arm"));
  added.warning_distance = 0.75;
  const AppliedOperations applied = run(scene, {added});
  ASSERT_EQ(applied.faults.size(), 1U);
  EXPECT_TRUE(mentions(applied.faults[0].error.what(),
                       "body 'tray': warning_distance 0.75 m is beyond the cutoff of 0.5 m"))
      << applied.faults[0].error.what();
  added.warning_distance = 0.5;
  EXPECT_TRUE(run(scene, {added}).faults.empty());
}

TEST(ApplyOperations, RefusesABodyThatIsBeyondTheLimitAndABatchThatIsTooLong) {
  Scene scene = cell();
  scene.limits.bodies = 6;
  const AppliedOperations applied = run(scene, {add(body("a", "world")), add(body("b", "world"))});
  ASSERT_EQ(applied.faults.size(), 1U);
  EXPECT_EQ(applied.faults[0].operation, 1U);
  EXPECT_TRUE(mentions(applied.faults[0].error.what(), "6 bodies, the limit"));
  EXPECT_THROW(run(scene, std::vector<SceneOperation>(kMostOperations + 1)), Error);
}

TEST(ApplyOperations, ListsEveryFaultAndNoneThatOnlyFollowsFromAnother) {
  Scene scene = cell();
  SceneOperation unreadable = operation(OperationKind::Add, "mug");
  unreadable.problem = Error("body 'mug'", "its mesh has no triangle", "give one");
  const AppliedOperations applied = run(scene, {move("cup", at(0)), unreadable, move("mug", at(1)),
                                                attach("box", "mug"), detach("peg"), move("box", at(4))});
  ASSERT_EQ(applied.faults.size(), 3U);
  EXPECT_EQ(applied.faults[0].operation, 0U);
  EXPECT_EQ(applied.faults[0].body, "cup");
  EXPECT_EQ(applied.faults[1].operation, 1U);
  EXPECT_TRUE(mentions(applied.faults[1].error.what(), "no triangle"));
  EXPECT_EQ(applied.faults[2].operation, 4U);
  EXPECT_EQ(scene.bodies[*scene.findBody("box")].frame_from_body.translation().x(), 4.0)
      << "what has no fault is applied, for who drops nothing";
}

TEST(ApplyOperations, AppliesEachToWhatThoseBeforeHaveMade) {
  Scene scene = cell();
  const AppliedOperations applied =
      run(scene, {operation(OperationKind::Remove, "box"), add(body("box", "bench")), attach("box", "hand"),
                  detach("box"), margin("box", 0.2)});
  ASSERT_TRUE(applied.faults.empty()) << applied.faults[0].error.what();
  const SceneBody& box = scene.bodies[*scene.findBody("box")];
  EXPECT_EQ(box.frame, "world");
  EXPECT_NEAR((box.frame_from_body.matrix() - at(9).matrix()).norm(), 0.0, 1e-15);
  EXPECT_EQ(box.margin, 0.2);
}

TEST(MovedBody, IsWatchedAgainstBodiesOfItsFrameFromThenOn) {
  Scene scene = cell();
  EXPECT_FALSE(watches(scene, "box", "table")) << "nothing moves one against the other";
  ASSERT_TRUE(run(scene, {move("box", at(1.5))}).faults.empty());
  EXPECT_TRUE(watches(scene, "box", "table"));
  EXPECT_TRUE(watches(scene, "box", "peg"));
  EXPECT_FALSE(watches(scene, "peg", "table"));
  EXPECT_EQ(countRuledPairs(scene), allPairs(scene).size());
}

std::vector<std::optional<Isometry3d>> posesOf(const Scene& scene, const Frames& frames) {
  std::vector<std::optional<Isometry3d>> poses;
  for (const SceneBody& each : scene.bodies) {
    poses.emplace_back(frames.world_from.at(each.frame) * each.frame_from_body);
  }
  return poses;
}

/// The box of cell() is moved along x, past the table at 0; what the tracker says of them.
class MovedAlong {
 public:
  explicit MovedAlong(double cutoff) : scene_(cell()), tracker_({1, nullptr}) {
    scene_.defaults.pairs.tracker.cutoff = cutoff;
  }
  /// @return nullptr when no rule or no nearness has them tracked
  const TrackedPair* at(double x, double time) {
    EXPECT_TRUE(run(scene_, {move("box", Isometry3d(Eigen::Translation3d(x, 0, 0)))}).faults.empty());
    tracker_.setScene(scene_, false);
    tracker_.update(posesOf(scene_, {}), time);
    for (const auto& pair : tracker_.pairs()) {
      if (pair->origin->name == "box/table") return pair.get();
    }
    return nullptr;
  }

 private:
  Scene scene_;
  SceneTracker tracker_;
};

TEST(MovedBody, IsSolvedAnewAtTheSameTimeToo) {
  MovedAlong moved(100.0);
  for (const double x : {2.0, 3.0, 2.5}) {
    const TrackedPair* pair = moved.at(x, 1.0);
    ASSERT_NE(pair, nullptr);
    EXPECT_NEAR(pair->solution.distance, x - 1.0, 1e-12);
  }
}

TEST(MovedBody, ComesBackSoonWithTheIdsOfItsPairs) {
  MovedAlong moved(0.5);
  const TrackedPair* near = moved.at(1.2, 0.0);
  ASSERT_NE(near, nullptr);
  ASSERT_FALSE(near->solution.niches.empty());
  const std::uint64_t id = near->solution.niches.front().id;
  for (int i = 1; i < 10; ++i) moved.at(5.0 + i, 0.02 * i);
  EXPECT_EQ(moved.at(9.0, 0.2), nullptr) << "it is tracked no more";
  near = moved.at(1.2, 0.22);
  ASSERT_NE(near, nullptr);
  ASSERT_FALSE(near->solution.niches.empty());
  EXPECT_EQ(near->solution.niches.front().id, id);
}

TEST(AttachedBody, IsNotWatchedAgainstWhatItMayTouchUntilItIsDetached) {
  Scene scene = cell();
  setPairEnabled(scene, {"", "box", "arm"}, true, scene.defaults.pairs);  // a listed pair from now on
  ASSERT_EQ(scene.pairs.size(), 1U);
  const AppliedOperations applied = run(scene, {attach("box", "hand", {"ar*", "peg", "nobody"})});
  ASSERT_TRUE(applied.faults.empty());
  ASSERT_EQ(applied.remarks.size(), 1U);
  EXPECT_EQ(applied.remarks[0].unknown, Names{"nobody"});
  EXPECT_FALSE(watches(scene, "box", "hand"));
  EXPECT_FALSE(watches(scene, "box", "arm"));
  EXPECT_FALSE(watches(scene, "box", "peg"));
  EXPECT_TRUE(watches(scene, "box", "table"));
  const PairList pairs = allPairs(scene);
  EXPECT_EQ(countRuledPairs(scene), pairs.size() - 1) << "one is listed";
  ASSERT_TRUE(run(scene, {detach("box")}).faults.empty());
  EXPECT_TRUE(watches(scene, "box", "hand"));
  EXPECT_TRUE(watches(scene, "box", "arm"));
  EXPECT_FALSE(watches(scene, "box", "table")) << "as before";
}

// Small scenes list all their pairs, because each has topics.
TEST(AttachedBody, RestsAgainAgainstBodiesOfTheFrameWhereItIsLeft) {
  Scene scene = cell();
  ASSERT_TRUE(run(scene, {attach("peg", "box"), attach("box", "hand")}).faults.empty());
  scene.pairs = allPairs(scene);
  EXPECT_TRUE(watches(scene, "box", "table"));
  EXPECT_TRUE(watches(scene, "peg", "table"));
  EXPECT_FALSE(watches(scene, "peg", "hand"));
  ASSERT_TRUE(run(scene, {detach("box")}).faults.empty());
  EXPECT_FALSE(watches(scene, "box", "table"));
  EXPECT_FALSE(watches(scene, "peg", "table"));
  EXPECT_TRUE(watches(scene, "peg", "hand"));
  EXPECT_TRUE(watches(scene, "box", "hand"));
}

TEST(AttachedBody, IsWatchedAgainAtRestWhereThatWasAskedForByName) {
  Scene scene = cell();
  ASSERT_TRUE(run(scene, {attach("peg", "box")}).faults.empty());
  for (const char* part : {"box", "peg"}) {
    setPairEnabled(scene, {"", part, "table"}, true, scene.defaults.pairs);
    ASSERT_TRUE(watches(scene, part, "table"));
  }
  ASSERT_TRUE(run(scene, {attach("box", "hand")}).faults.empty());
  listMatchingPairs(scene, {"*"});
  setPairEnabled(scene, {"table/hand", "", ""}, true, scene.defaults.pairs);
  EXPECT_TRUE(watches(scene, "peg", "table"));
  ASSERT_TRUE(run(scene, {detach("box"), attach("table", "hand")}).faults.empty());
  EXPECT_FALSE(watches(scene, "table", "hand")) << "it moves with it";
  ASSERT_TRUE(run(scene, {detach("table")}).faults.empty());
  EXPECT_TRUE(watches(scene, "table", "hand"));
  EXPECT_TRUE(watches(scene, "box", "table")) << "the pair was asked for";
  EXPECT_TRUE(watches(scene, "peg", "table")) << "likewise, of a body that was carried along";
}

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
    ASSERT_EQ(countRuledPairs(scene_), tracked.size());
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
  EXPECT_EQ(countRuledPairs(scene), 2U * 103U + 1U) << "each against the two links, and these";
}

}  // namespace
}  // namespace concave_distance::apply_operations_test
