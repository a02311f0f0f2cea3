#include "scene/scene_edits.h"

#include <gtest/gtest.h>

#include <random>

#include "concave_distance/base/error.h"
#include "scene/set_warning_distance.h"

namespace concave_distance::scene_edits_test {
namespace {

using Names = std::vector<std::string>;

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
  for (const ScenePair& pair : allPairs(scene)) {
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
  EXPECT_TRUE(isRosName(std::string(200, 'a')));
  EXPECT_FALSE(isRosName(std::string(201, 'a')));
}

TEST(AddBody, PairsWithBodiesOfOtherFrames) {
  const Scene scene = threeBodies();
  EXPECT_EQ(names(scene), (std::vector<std::string>{"table/arm", "shelf/arm"}))
      << "table and shelf are fixed to one frame and never move against each other";
}

TEST(AddBody, PairsWithThoseNamedOnceEach) {
  Scene scene = threeBodies();
  EXPECT_EQ(addBody(scene, body("cup", "world"), {{"table", "table"}, false, {}, {}}, {}).names,
            std::vector<std::string>{"cup/table"});
}

TEST(AddBody, AddsABodyThatIsWatchedAgainstNothing) {
  Scene scene = threeBodies();
  EXPECT_TRUE(addBody(scene, body("cup", "cup"), {{}, true}, {}).names.empty());
  EXPECT_EQ(names(scene).size(), 2U);
  EXPECT_THROW(addBody(scene, body("mug", "mug"), {{"table"}, true}, {}), Error);
}

std::string refusalOfBody(Scene& scene, const PairPartners& partners) {
  try {
    addBody(scene, body("cup", "cup"), partners, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(AddBody, RefusesWhatWouldBeBeyondALimitWithTheFigureAndAddsNothing) {
  Scene scene = threeBodies();
  scene.limits.pairs = 2;
  const std::string pairs = refusalOfBody(scene, {{"arm", "table", "shelf"}, false});
  EXPECT_NE(pairs.find("3 new named pairs besides the 0"), std::string::npos) << pairs;
  EXPECT_NE(pairs.find("the limit is 2"), std::string::npos) << pairs;
  EXPECT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(refusalOfBody(scene, {{"arm", "table"}, false}), "accepted");
  EXPECT_EQ(scene.pairs.size(), 2U);
  EXPECT_THROW(setPairEnabled(scene, {"", "table", "shelf"}, true, {}), Error);
  removeBody(scene, "cup");
  EXPECT_EQ(refusalOfBody(scene, {}), "accepted") << "pairs by rule take no place until they are near";
  removeBody(scene, "cup");
  scene.limits.bodies = 3;
  EXPECT_NE(refusalOfBody(scene, {{}, true}).find("3 bodies, the limit"), std::string::npos);
}

TEST(RemoveBody, LeavesNamesAndPairsThatAreFoundByTheirNewPlaces) {
  Scene scene = threeBodies();
  addBody(scene, body("cup", "cup"), {}, {});
  const Scene before = scene;
  removeBody(scene, "arm");
  EXPECT_EQ(before.bodies.size(), 4U) << "a copy is not changed with it";
  EXPECT_EQ(names(scene), (std::vector<std::string>{"cup/table", "cup/shelf"}));
  ASSERT_TRUE(pairOf(scene, 1, 2).has_value());
  const ScenePair pair = *pairOf(scene, 1, 2);
  EXPECT_EQ(scene.bodies[pair.body_a].name, "cup");
  EXPECT_EQ(scene.bodies[pair.body_b].name, "shelf");
  EXPECT_FALSE(scene.findBody("arm").has_value());
  EXPECT_EQ(&before.bodies[1], &scene.bodies[0]) << "what was not edited is shared";
}

TEST(SceneEdits, FindThousandsOfBodiesAndPairsByName) {
  Scene scene;
  addBody(scene, body("hub", "hub"), {}, {});
  for (int i = 0; i < 3000; ++i) {
    addBody(scene, body("b" + std::to_string(i), "f"), {{"hub"}, false}, {});
  }
  for (int i = 0; i < 3000; i += 7) {
    const std::string name = "b" + std::to_string(i);
    ASSERT_EQ(scene.findBody(name), static_cast<std::size_t>(i + 1));
    ASSERT_EQ(scene.findPair("hub", name), static_cast<std::size_t>(i));
    ASSERT_EQ(scene.pairs.find(name + "/hub"), static_cast<std::size_t>(i));
    ASSERT_FALSE(scene.findPair("b1", name).has_value());
  }
  EXPECT_FALSE(scene.findBody("b3000").has_value());
}

TEST(AddBody, RefusesTakenBadAndUnknownNamesAndChangesNothing) {
  Scene scene = threeBodies();
  EXPECT_THROW(addBody(scene, body("arm", "x"), {}, {}), Error);
  EXPECT_THROW(addBody(scene, body("my cup", "x"), {}, {}), Error);
  EXPECT_THROW(addBody(scene, body("cup", "x"), {{"nobody"}, false, {}, {}}, {}), Error);
  EXPECT_THROW(addBody(scene, body("cup", "x"), {{"cup"}, false, {}, {}}, {}), Error);
  EXPECT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(names(scene).size(), 2U);
}

TEST(AddBody, LeavesOutWhatCannotMoveAgainstItAndWhatItMayTouch) {
  Scene scene = threeBodies();
  addBody(scene, body("hand", "hand"), {}, {});
  scene.rigid.join("hand", "arm");
  const AddedPairs held = addBody(scene, body("cup", "hand"), {{}, false, {"table", "no_body"}, {}}, {});
  EXPECT_EQ(held.names, std::vector<std::string>{"cup/shelf"});
  EXPECT_EQ(held.rigid_neighbours, std::vector<std::string>{"arm"});
  EXPECT_EQ(held.unknown, std::vector<std::string>{"no_body"});
  const auto all_rigid = [](const std::string&, const std::string&) { return true; };
  EXPECT_TRUE(addBody(scene, body("label", "cup_frame"), {{}, false, {}, all_rigid}, {}).names.empty());
  EXPECT_THROW(addBody(scene, body("lid", "x"), {{"arm"}, false, {"table"}, {}}, {}), Error);
}

TEST(RemoveBody, LeavesRobotLinksUnlessAsked) {
  Scene scene = threeBodies();
  scene.bodies.edit(0).is_robot_link = true;
  EXPECT_THROW(removeBody(scene, "arm"), Error);
  EXPECT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(removeBody(scene, "arm", true).size(), 2U);
}

TEST(RemoveBody, TakesItsPairsAndKeepsTheOthersRight) {
  Scene scene = threeBodies();
  EXPECT_EQ(removeBody(scene, "table"), std::vector<std::string>{"table/arm"});
  const PairList left = allPairs(scene);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(scene.bodies[left[0].body_a].name, "shelf");
  EXPECT_EQ(scene.bodies[left[0].body_b].name, "arm");
  EXPECT_THROW(removeBody(scene, "table"), Error);
}

TEST(SetPairEnabled, FindsPairsByNameAndByBodiesInEitherOrder) {
  Scene scene = threeBodies();
  EXPECT_EQ(setPairEnabled(scene, {"table/arm", "", ""}, false, {}), Names{"table/arm"});
  EXPECT_FALSE(scene.pairs[0].enabled);
  EXPECT_EQ(setPairEnabled(scene, {"", "arm", "table"}, true, {}), Names{"table/arm"});
  EXPECT_TRUE(scene.pairs[0].enabled) << "named, so listed";
  EXPECT_THROW(setPairEnabled(scene, {"nobody/arm", "", ""}, true, {}), Error);
  EXPECT_THROW(setPairEnabled(scene, {"", "arm", "nobody"}, true, {}), Error);
  EXPECT_THROW(setPairEnabled(scene, {"", "arm", "arm"}, true, {}), Error);
}

TEST(SetPairEnabled, CreatesAPairThatAFilterLeftOut) {
  Scene scene = threeBodies();
  PairSettings settings;
  settings.warning_distance = 0.5;
  EXPECT_THROW(setPairEnabled(scene, {"", "table", "shelf"}, false, settings), Error);
  EXPECT_EQ(setPairEnabled(scene, {"", "table", "shelf"}, true, settings), Names{"table/shelf"});
  EXPECT_EQ(scene.pairs.back().settings.warning_distance, 0.5);
}

// Settings of groups and patterns belong to a rule, not to a list.
TEST(PairRules, TakeSettingsAndNamesByPatternWithoutAList) {
  Scene scene;
  for (int i = 0; i < 8; ++i) {
    addBody(scene, body("b" + std::to_string(i), "f" + std::to_string(i)), {}, {});
  }
  EXPECT_EQ(countPairsByRule(scene), 28U);
  EXPECT_EQ(setPairEnabled(scene, {"b7/*", "", ""}, false, {}).size(), 7U);
  EXPECT_EQ(countPairsByRule(scene), 21U);
  EXPECT_EQ(setWarningDistance(scene, "b1/*", 0.25, 0.0).size(), 7U);
  EXPECT_TRUE(scene.pairs.empty());
  for (const ScenePair& pair : allPairs(scene)) {
    const bool has_1 = pair.body_a == 1 || pair.body_b == 1;
    const bool has_7 = pair.body_a == 7 || pair.body_b == 7;
    EXPECT_EQ(pair.settings.warning_distance.has_value(), has_1) << pair.name;
    EXPECT_EQ(pair.enabled, !has_7) << pair.name;
    EXPECT_GT(pair.body_a, pair.body_b) << "the added one is A";
  }
  // One that is named is listed, with what the rules have said of it.
  EXPECT_EQ(setPairEnabled(scene, {"b7/b1", "", ""}, true, {}), Names{"b7/b1"});
  ASSERT_EQ(scene.pairs.size(), 1U);
  EXPECT_EQ(scene.pairs[0].settings.warning_distance, 0.25);
  EXPECT_EQ(countPairsByRule(scene), 21U);
  // A body of the same settings as those that were added needs no rule of its own.
  const std::size_t rules = scene.rules.list.size();
  addBody(scene, body("late", "late"), {}, {});
  EXPECT_EQ(countPairsByRule(scene), 21U + 8U);
  EXPECT_EQ(scene.rules.list.size(), rules);
  const BodySet others({0, 2, 3, 4, 5, 6, 8});
  EXPECT_EQ(countPairsByRule(scene, {{others, others}}), 15U + 6U);
}

// A scene file with it would not load again.
TEST(SetWarningDistance, RefusesOneBeyondTheCutoffOfAPair) {
  Scene scene = threeBodies();
  scene.defaults.pairs.tracker.cutoff = 0.5;
  addBody(scene, body("cup", "cup"), {}, scene.defaults.pairs);
  for (const std::string pattern : {"cup/*", "cup/table"}) {
    EXPECT_FALSE(setWarningDistance(scene, pattern, 0.5, 0.0).empty());
    Scene edited = scene;
    try {
      setWarningDistance(edited, pattern, 0.75, 0.0);
      FAIL() << pattern;
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("'" + pattern + "': warning_distance 0.75 m is beyond the cutoff of 0.5 m"),
                std::string::npos)
          << text;
      EXPECT_NE(text.find("raise cutoff or lower warning_distance"), std::string::npos) << text;
    }
  }
}

// The number that is counted is that of the pairs tried one by one.
TEST(PairRules, CountWhatTheyWatch) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 engine(seed);
    const auto below = [&](unsigned n) { return engine() % n; };
    Scene scene;
    for (int i = 0; i < 12; ++i) {
      PairPartners partners;
      const std::string name = "b" + std::to_string(i);
      if (i > 2 && below(3) == 0)
        partners.names = {"b" + std::to_string(below(static_cast<unsigned>(i))), "b?"};
      if (i > 2 && partners.names.empty() && below(3) == 0) partners.may_touch = {"b1", "b2"};
      partners.none = partners.names.empty() && partners.may_touch.empty() && below(6) == 0;
      PairSettings settings;
      if (below(4) == 0) settings.warning_distance = 0.1 * static_cast<double>(below(3));
      addBody(scene, body(name, "f" + std::to_string(below(9))), partners, settings);
      if (below(5) == 0) scene.rigid.join("f" + std::to_string(below(9)), "f" + std::to_string(below(9)));
    }
    for (int edit = 0; edit < 4; ++edit) {
      const std::string digit = std::to_string(below(10));
      try {
        if (edit % 2 == 0) {
          setPairEnabled(scene, {"", "b" + digit, "b[2-8]"}, below(2) == 0, {});
        } else {
          setPairEnabled(scene, {"b" + digit + "/*", "", ""}, below(2) == 0, {});
        }
        if (below(3) == 0) removeBody(scene, "b" + digit);
      } catch (const Error&) {
        // No such pair or body now.
      }
    }
    std::size_t count = 0;
    for (const ScenePair& pair : allPairs(scene)) {
      count += pair.enabled && !scene.pairs.find(pair.body_a, pair.body_b) ? 1 : 0;
    }
    EXPECT_EQ(countPairsByRule(scene), count) << "seed " << seed;
  }
}

// Two fingers on a hand, a table and a shelf in the world; the group names a body that is not there, too.
Scene handAndRoom() {
  Scene scene;
  for (const char* name : {"hand", "finger_l", "finger_r"}) {
    SceneBody link = body(name, name);
    link.is_robot_link = true;
    scene.bodies.push_back(link);
  }
  for (const char* name : {"table", "shelf"}) scene.bodies.push_back(body(name, "world"));
  scene.rigid.join("hand", "finger_l");
  scene.groups["fingers"] = {"finger_l", "gone", "finger_r"};
  scene.groups["empty"] = {"gone"};
  return scene;
}

TEST(AddBody, TakesGroupsAndPatternsForBodies) {
  Scene scene = handAndRoom();
  EXPECT_EQ(addBody(scene, body("cup", "cup"), {{"fingers", "t*", "table"}}, {}).names,
            Names({"cup/table", "cup/finger_l", "cup/finger_r"}));
  EXPECT_EQ(addBody(scene, body("mug", "mug"), {{}, false, {"finger_?", "cup", "nobody", "no*"}}, {}).names,
            Names({"mug/hand", "mug/table", "mug/shelf"}));
  const AddedPairs held = addBody(scene, body("ring", "finger_l"), {{}, false, {"fingers"}}, {});
  EXPECT_EQ(held.names, Names({"ring/table", "ring/shelf", "ring/cup", "ring/mug"}));
  EXPECT_TRUE(held.unknown.empty());
  EXPECT_EQ(held.rigid_neighbours, Names{"hand"});
}

TEST(AddBody, LeavesOutOfGroupsWhatCannotMoveAgainstItUnlessItIsNamed) {
  Scene scene = handAndRoom();
  const AddedPairs of_group = addBody(scene, body("palm", "hand"), {{"fingers"}}, {});
  EXPECT_EQ(of_group.names, Names{"palm/finger_r"});
  EXPECT_EQ(of_group.rigid_neighbours, Names{"finger_l"});
  const AddedPairs named = addBody(scene, body("back", "hand"), {{"fingers", "finger_l"}}, {});
  EXPECT_EQ(named.names, Names({"back/finger_l", "back/finger_r"}));
}

TEST(AddBody, RefusesGroupsAndPatternsWithoutABody) {
  Scene scene = handAndRoom();
  for (const std::string& name : Names{"empty", "x*", "nobody", "[", std::string(5000, '*')}) {
    EXPECT_THROW(addBody(scene, body("cup", "cup"), {{name}}, {}), Error) << name;
  }
  EXPECT_EQ(scene.bodies.size(), 5U);
}

TEST(SetPairEnabled, TakesGroupsAndPatternsForBodies) {
  Scene scene = handAndRoom();
  addBody(scene, body("cup", "cup"), {{"fingers", "table"}}, {});
  EXPECT_EQ(setPairEnabled(scene, {"", "fingers", "cup"}, false, {}),
            Names({"cup/finger_l", "cup/finger_r"}));
  EXPECT_FALSE(findPairNamed(scene, "cup/finger_l")->enabled);
  EXPECT_TRUE(findPairNamed(scene, "cup/table")->enabled);
  EXPECT_EQ(setPairEnabled(scene, {"cup/*", "", ""}, false, {}),
            Names({"cup/table", "cup/finger_l", "cup/finger_r"}));
  // What is not there yet is created where no filter of a robot or of rigid frames can have left it out.
  EXPECT_EQ(setPairEnabled(scene, {"", "cup", "*"}, true, {}),
            Names({"cup/finger_l", "cup/finger_r", "cup/table", "cup/hand", "cup/shelf"}));
  EXPECT_THROW(setPairEnabled(scene, {"", "fingers", "h*"}, true, {}), Error) << "links of a robot";
  EXPECT_THROW(setPairEnabled(scene, {"", "table", "sh*"}, true, {}), Error) << "one frame";
  EXPECT_THROW(setPairEnabled(scene, {"", "fingers", "table"}, false, {}), Error) << "no pair to switch off";
  EXPECT_THROW(setPairEnabled(scene, {"", "empty", "table"}, true, {}), Error);
  EXPECT_EQ(setPairEnabled(scene, {"", "finger_l", "hand"}, true, {}), Names{"finger_l/hand"}) << "named";
}

}  // namespace
}  // namespace concave_distance::scene_edits_test
