// Which bodies stand for a group, and how many pairs face it.
#include "scene/group_members.h"

#include <gtest/gtest.h>

#include "base/random_engine.h"
#include "scene/apply_operations.h"
#include "scene/scene_edits.h"
#include "support/box_scene.h"

namespace concave_distance::group_members_test {
namespace {

using detail::GroupMembers;
using detail::OperationKind;
using detail::SceneOperation;

/// A robot of two links, a table, and boxes; `fingertip` is a frame that a fixed joint connects with `hand`.
Scene cell() {
  Scene scene;
  for (const char* name : {"hand", "arm", "table", "box", "peg"}) {
    SceneBody body = unitBox(name);
    body.is_robot_link = body.name == "hand" || body.name == "arm";
    if (!body.is_robot_link) body.frame = "world";
    addBody(scene, body, {}, scene.defaults.pairs);
  }
  scene.rigid.join("fingertip", "hand");
  scene.groups["gripper"] = {"hand", "finger"};
  scene.groups["robot"] = {"arm", "hand"};
  scene.groups["empty"] = {};
  return scene;
}

void apply(Scene& scene, OperationKind kind, const std::string& body, const std::string& other = "") {
  detail::FramesNow frames{
      "world", [](const std::string&, const std::string&) { return std::optional(detail::FrameRelation()); }};
  SceneOperation operation;
  operation.kind = kind;
  operation.body = body;
  operation.other = other;
  const auto applied = detail::applyOperations(scene, {operation}, frames);
  ASSERT_TRUE(applied.faults.empty()) << applied.faults.front().error.what();
}

/// The names of the groups that face each other in a pair.
std::string facing(const Scene& scene, const std::string& a, const std::string& b) {
  const GroupMembers members(scene);
  const GroupMembers::Mask mask = members.facing(*scene.findBody(a), *scene.findBody(b));
  std::string names;
  for (std::size_t i = 0; i < members.names().size(); ++i) {
    if ((mask >> i & 1U) != 0) names += members.names()[i] + " ";
  }
  return names;
}

TEST(GroupMembers, FaceEverythingButThemselves) {
  const Scene scene = cell();
  EXPECT_EQ(facing(scene, "hand", "table"), "gripper robot ");
  EXPECT_EQ(facing(scene, "arm", "table"), "robot ");
  EXPECT_EQ(facing(scene, "arm", "hand"), "gripper ") << "links of the robot do not hide its obstacles";
  EXPECT_EQ(facing(scene, "box", "table"), "");
}

TEST(GroupMembers, TakeInWhatIsAttachedToThemAsLongAsItIs) {
  Scene scene = cell();
  apply(scene, OperationKind::Attach, "peg", "box");
  apply(scene, OperationKind::Attach, "box", "hand");
  EXPECT_EQ(facing(scene, "box", "table"), "gripper robot ");
  EXPECT_EQ(facing(scene, "peg", "table"), "gripper robot ") << "through the box";
  EXPECT_EQ(facing(scene, "peg", "arm"), "gripper ");
  apply(scene, OperationKind::Detach, "box");
  EXPECT_EQ(facing(scene, "peg", "table"), "");
  apply(scene, OperationKind::Attach, "table", "fingertip");
  EXPECT_EQ(facing(scene, "table", "peg"), "gripper robot ") << "a frame without a body that moves with it";
}

TEST(GroupMembers, CountTheirPairs) {
  RandomEngine engine(7);
  Scene scene = cell();
  for (int step = 0; step < 60; ++step) {
    const std::string body = scene.bodies[2 + engine() % 3].name;
    const auto& attachment = scene.bodies[*scene.findBody(body)].attachment;
    if (attachment) {
      apply(scene, OperationKind::Detach, body);
    } else if (engine() % 2 == 0) {
      apply(scene, OperationKind::Attach, body, engine() % 2 == 0 ? "hand" : "arm");
    } else {
      apply(scene, OperationKind::Move, body);
    }
    const GroupMembers members(scene);
    const PairList pairs = allPairs(scene);
    for (std::size_t group = 0; group < members.names().size(); ++group) {
      std::size_t count = 0;
      for (const ScenePair& pair : pairs) count += members.facing(pair.body_a, pair.body_b) >> group & 1U;
      ASSERT_EQ(members.countFacing(scene, group), count) << members.names()[group] << ", step " << step;
    }
  }
}

TEST(GroupMembers, AreThoseOfTheFirstGroupsByName) {
  Scene scene = cell();
  for (int i = 0; i < 100; ++i) scene.groups["z" + std::to_string(i)] = {"table"};
  EXPECT_EQ(GroupMembers(scene).names().size(), GroupMembers::kMostGroups);
  EXPECT_EQ(GroupMembers(scene).names().front(), "empty");
}

}  // namespace
}  // namespace concave_distance::group_members_test
