// Batches of operations on a scene: what is refused, and which pairs are watched after it.
#include "scene/apply_operations.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"
#include "operations_fixture.h"
#include "scene/rule_edits.h"
#include "support/scene_fixture.h"

namespace concave_distance::apply_operations_test {
namespace {

using Eigen::Isometry3d;
using namespace detail;
using namespace test::operations;
using test::mentions;
using Names = std::vector<std::string>;

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
  EXPECT_NO_THROW(requireBatchSize(kMostOperations));
  EXPECT_THROW(requireBatchSize(kMostOperations + 1), Error);
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
  EXPECT_EQ(countPairsByRule(scene), allPairs(scene).size());
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
  EXPECT_EQ(countPairsByRule(scene), pairs.size() - 1) << "one is listed";
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

}  // namespace
}  // namespace concave_distance::apply_operations_test
