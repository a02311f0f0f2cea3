// Which bodies stand for a group, and how many pairs face it.
#include "scene/matching_bodies.h"

#include <gtest/gtest.h>

#include "base/random_engine.h"
#include "scene/apply_operations.h"
#include "scene/scene_edits.h"
#include "support/box_scene.h"

namespace concave_distance::matching_bodies_test {
namespace {

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

/// The names of the groups that one body of the pair stands for and the other does not.
std::string facing(const Scene& scene, const std::string& a, const std::string& b) {
  std::string names;
  for (const auto& group : scene.groups) {
    const std::vector<bool> stands = detail::standingFor(scene, group.first);
    if (stands[*scene.findBody(a)] != stands[*scene.findBody(b)]) names += group.first + " ";
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
    const PairList pairs = allPairs(scene);
    for (const auto& group : scene.groups) {
      const std::vector<bool> stands = detail::standingFor(scene, group.first);
      std::size_t count = 0;
      for (const ScenePair& pair : pairs) count += stands[pair.body_a] != stands[pair.body_b] ? 1 : 0;
      ASSERT_EQ(detail::countFacing(scene, stands), count) << group.first << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace concave_distance::matching_bodies_test
