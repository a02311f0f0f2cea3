#include "concave_distance/ros/scene_edits.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

SceneBody body(const std::string& name, const std::string& frame) {
  SceneBody result;
  result.name = name;
  result.frame = frame;
  return result;
}

Scene threeBodies() {
  Scene scene;
  addBody(scene, body("arm", "arm"), {}, {});
  addBody(scene, body("table", "world"), {}, {});
  addBody(scene, body("shelf", "world"), {}, {});
  return scene;
}

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> result;
  for (const ScenePair& pair : scene.pairs) {
    result.push_back(pair.name);
  }
  return result;
}

TEST(RosName, IsWhatMayStandInATopic) {
  for (const char* good : {"a", "a_1/b", "Arm2"}) {
    EXPECT_TRUE(isRosName(good)) << good;
  }
  for (const char* bad : {"", "1a", "a-b", "/a", "a/", "a//b", "a b", "_a", "a.b"}) {
    EXPECT_FALSE(isRosName(bad)) << bad;
  }
}

TEST(AddBody, PairsWithBodiesOfOtherFrames) {
  const Scene scene = threeBodies();
  EXPECT_EQ(names(scene), (std::vector<std::string>{"table/arm", "shelf/arm"}))
      << "table and shelf are fixed to one frame and never move against each other";
}

TEST(AddBody, PairsWithThoseNamedOnceEach) {
  Scene scene = threeBodies();
  EXPECT_EQ(addBody(scene, body("cup", "world"), {"table", "table"}, {}),
            std::vector<std::string>{"cup/table"});
}

TEST(AddBody, RefusesTakenBadAndUnknownNamesAndChangesNothing) {
  Scene scene = threeBodies();
  EXPECT_THROW(addBody(scene, body("arm", "x"), {}, {}), Error);
  EXPECT_THROW(addBody(scene, body("my cup", "x"), {}, {}), Error);
  EXPECT_THROW(addBody(scene, body("cup", "x"), {"nobody"}, {}), Error);
  EXPECT_THROW(addBody(scene, body("cup", "x"), {"cup"}, {}), Error);
  EXPECT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(scene.pairs.size(), 2U);
}

TEST(RemoveBody, TakesItsPairsAndKeepsTheOthersRight) {
  Scene scene = threeBodies();
  EXPECT_EQ(removeBody(scene, "table"), std::vector<std::string>{"table/arm"});
  ASSERT_EQ(scene.pairs.size(), 1U);
  EXPECT_EQ(scene.bodies[scene.pairs[0].body_a].name, "shelf");
  EXPECT_EQ(scene.bodies[scene.pairs[0].body_b].name, "arm");
  EXPECT_THROW(removeBody(scene, "table"), Error);
}

TEST(SetPairEnabled, FindsPairsByNameAndByBodiesInEitherOrder) {
  Scene scene = threeBodies();
  EXPECT_EQ(setPairEnabled(scene, {"table/arm", "", ""}, false, {}), "table/arm");
  EXPECT_FALSE(scene.pairs[0].enabled);
  EXPECT_EQ(setPairEnabled(scene, {"", "arm", "table"}, true, {}), "table/arm");
  EXPECT_TRUE(scene.pairs[0].enabled);
  EXPECT_THROW(setPairEnabled(scene, {"nobody/arm", "", ""}, true, {}), Error);
  EXPECT_THROW(setPairEnabled(scene, {"", "arm", "nobody"}, true, {}), Error);
  EXPECT_THROW(setPairEnabled(scene, {"", "arm", "arm"}, true, {}), Error);
}

TEST(SetPairEnabled, CreatesAPairThatAFilterLeftOut) {
  Scene scene = threeBodies();
  PairSettings settings;
  settings.warning_distance = 0.5;
  EXPECT_THROW(setPairEnabled(scene, {"", "table", "shelf"}, false, settings), Error);
  EXPECT_EQ(setPairEnabled(scene, {"", "table", "shelf"}, true, settings), "table/shelf");
  EXPECT_EQ(scene.pairs.back().settings.warning_distance, 0.5);
}

}  // namespace
}  // namespace concave_distance
