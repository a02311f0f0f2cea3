#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_fixture.h"

namespace concave_distance::scene_pairs_test {
namespace {

using test::boxLink;
using test::hasNote;
using test::joint;
using test::mentions;
using test::pairNames;
using test::robot;

using Names = std::vector<std::string>;

/// Bodies a, b, c, hook.1 and hook-1 and a missing one; a robot of links base, arm and tool in a row.
class ScenePairs : public test::SceneTest {
 protected:
  ScenePairs() {
    options.descriptions["robot"] = robot(boxLink("base") + boxLink("arm") + boxLink("tool") +
                                          test::bareLink("flange") + joint("revolute", "base", "arm") +
                                          joint("revolute", "arm", "tool") + joint("fixed", "arm", "flange"));
  }
  static std::string bodies(const Names& names) {
    std::string text = "defaults: {max_edge_length: 100}\nbodies:\n";
    for (const std::string& name : names) {
      text += name == "missing" ? "  - {name: missing, mesh: missing.stl}\n"
                                : "  - {name: " + name + ", box: {size: [1, 1, 1]}}\n";
    }
    return text;
  }
  const std::string abc = bodies({"a", "b", "c"});
  const std::string robot_scene = "robots: [{description: robot}]\n" + bodies({"table", "shelf"});
};

TEST_F(ScenePairs, WithoutPairsEveryBodyIsWatchedAgainstEveryOther) {
  EXPECT_EQ(pairNames(load(abc)), Names({"a/b", "a/c", "b/c"}));
}

TEST_F(ScenePairs, AnEmptyListIsNoPair) {
  EXPECT_TRUE(allPairs(load(abc + "pairs: []\n")).empty());
}

TEST_F(ScenePairs, BodiesGroupsAndPatternsMayStandOnEitherSide) {
  const std::string groups = "groups: {walls: [b, c], all: ['*']}\n";
  EXPECT_EQ(pairNames(load(abc + "pairs: [{between: [b, a]}]\n")), Names({"b/a"}));
  EXPECT_EQ(pairNames(load(abc + groups + "pairs: [{between: [a, walls]}]\n")), Names({"a/b", "a/c"}));
  EXPECT_EQ(pairNames(load(abc + groups + "pairs: [{between: [walls, 'a*']}]\n")), Names({"b/a", "c/a"}));
  EXPECT_EQ(pairNames(load(abc + groups + "pairs: [{between: ['[ab]', c]}]\n")), Names({"a/c", "b/c"}));
}

TEST_F(ScenePairs, AGroupAgainstItselfGivesItsSelfPairsOnce) {
  EXPECT_EQ(pairNames(load(abc + "pairs: [{between: ['*', '*']}]\n")), Names({"a/b", "a/c", "b/c"}));
  EXPECT_EQ(pairNames(load(abc + "groups: {g: [c, a]}\npairs: [{between: [g, '*']}]\n")),
            Names({"a/b", "a/c", "c/b"}))
      << "of two bodies that stand on both sides the earlier one is A";
}

TEST_F(ScenePairs, GroupsMayHoldGroupsThatStandAboveThem) {
  EXPECT_EQ(pairNames(load(abc + "groups: {g: [c], h: [g, b]}\npairs: [{between: [a, h]}]\n")),
            Names({"a/b", "a/c"}));
  EXPECT_TRUE(mentions(
      refusal(abc + "groups:\n  h: [g, b]\n  g: [c]\n"),
      "scene.yaml:7, groups.h[0]: 'g' is not a body, link or group (bodies: a, b, c; groups: none)"));
}

TEST_F(ScenePairs, RobotIsAGroupOfItsOwn) {
  EXPECT_EQ(pairNames(load(robot_scene + "pairs: [{between: [arm, table]}]\n")), Names({"arm/table"}));
  EXPECT_EQ(pairNames(load("robots: [{description: robot, name: kuka}]\n" + bodies({"table"}) +
                           "pairs: [{between: [kuka, table]}]\n")),
            Names({"base/table", "arm/table", "tool/table"}));
  // The URDF's own name, `arm`, is a link's, too: the link wins and a note says so.
  EXPECT_TRUE(hasNote(load(robot_scene), "group 'arm' of a robot is not there"));
}

TEST_F(ScenePairs, TwoRobotsWithPrefixesAreTwoGroups) {
  const Scene scene = load(
      "defaults: {max_edge_length: 100}\n"
      "robots: [{description: robot, prefix: l_}, {description: robot, prefix: r_}]\n"
      "groups: {left: ['l_*'], right: ['r_*']}\n"
      "pairs: [{between: [left, right]}]\n");
  EXPECT_EQ(allPairs(scene).size(), 9U);
  EXPECT_EQ(allPairs(scene)[1].name, "l_base/r_arm");
  EXPECT_TRUE(scene.pairs.empty()) << "they follow a rule";
}

TEST_F(ScenePairs, UnknownNamesAreRefusedWithWhatThereIs) {
  EXPECT_TRUE(mentions(
      refusal(abc + "groups: {g: [b]}\npairs:\n  - between: [a, d]\n"),
      "scene.yaml:8, pairs[0].between[1]: 'd' is not a body, link or group (bodies: a, b, c; groups: g)"));
  EXPECT_TRUE(mentions(refusal(abc + "pairs:\n  - between: [a, 'x*']\n"), "'x*' matches no body"));
  EXPECT_TRUE(
      mentions(refusal(abc + "disable:\n  - [a, d]\n"), "scene.yaml:7, disable[0][1]: 'd' is not a body"));
  EXPECT_TRUE(mentions(refusal(abc + "groups:\n  g: [d]\n"), "scene.yaml:7, groups.g[0]: 'd' is not a body"));
}

TEST_F(ScenePairs, FormOfPairsIsChecked) {
  EXPECT_TRUE(mentions(refusal(abc + "pairs:\n  - {}\n"), "scene.yaml:7, pairs[0]: 'between' is missing"));
  EXPECT_TRUE(
      mentions(refusal(abc + "pairs:\n  - between: [a]\n"), "pairs[0].between: the value is a list of 1"));
  EXPECT_TRUE(mentions(refusal(abc + "pairs:\n  - between: a\n"), "a list of two"));
  EXPECT_TRUE(mentions(refusal(abc + "pairs: {}\n"), "allowed: a list of pairs"));
  EXPECT_TRUE(mentions(refusal(abc + "disable: [a]\n"), "disable[0]: the value is 'a'"));
  EXPECT_TRUE(mentions(refusal(abc + "groups: [a]\n"), "groups: the value is a list of 1"));
  EXPECT_TRUE(mentions(refusal(abc + "groups: {g: a}\n"), "groups.g: the value is 'a'"));
  EXPECT_TRUE(mentions(refusal(abc + "groups: {'g*': [a]}\n"), "'g*' is no name for a group"));
  EXPECT_TRUE(mentions(refusal(abc + "pairs: [{between: [a, a]}]\n"), "'a' against itself"));
  EXPECT_TRUE(mentions(refusal(abc + "pairs: [{between: [a, b], enabled: 1}]\n"), "true or false"));
  for (const std::string name : {"'a b'", "/a", "a/", "a//b", "a-b"}) {
    EXPECT_TRUE(
        mentions(refusal(abc + "pairs: [{between: [a, b], name: " + name + "}]\n"), "letters, digits"));
  }
  EXPECT_TRUE(mentions(refusal(abc + "pairs: [{between: [a, '*'], name: p}]\n"),
                       "the name 'p' for more than one pair"));
}

TEST_F(ScenePairs, SettingsAreLaidOverOneAnotherAndThePairsOwnEntryLast) {
  const Scene scene = load(
      "defaults: {max_edge_length: 100, cutoff: 9, least_prominence: 0.5, expert: {random_starts: 1}}\n"
      "bodies:\n"
      "  - {name: a, box: {size: [1, 1, 1]}}\n  - {name: b, box: {size: [1, 1, 1]}}\n"
      "  - {name: c, box: {size: [1, 1, 1]}}\n"
      "pairs:\n"
      "  - {between: [b, c], cutoff: 5, name: own/name}\n"
      "  - {between: ['*', '*'], cutoff: 7, least_prominence: 0.25}\n"
      "  - {between: [a, '*'], least_prominence: 0.125, expert: {warm: {population_size: 8}}}\n");
  EXPECT_EQ(pairNames(scene), Names({"own/name", "a/b", "a/c"}));
  EXPECT_EQ(scene.pairs.size(), 1U) << "only what is named by both bodies is listed";
  const auto tracker = [&](std::size_t i) { return allPairs(scene)[i].settings.tracker; };
  EXPECT_EQ(tracker(0).cutoff, 5.0);  // its own entry stands first and wins all the same
  EXPECT_EQ(tracker(0).least_prominence, 0.25);
  EXPECT_EQ(tracker(1).cutoff, 7.0);
  EXPECT_EQ(tracker(1).least_prominence, 0.125);
  EXPECT_EQ(tracker(1).warm.population_size, 8U);
  EXPECT_EQ(tracker(0).warm.population_size, TrackerParameters().warm.population_size);
  EXPECT_EQ(tracker(2).random_starts, 1U);
}

TEST_F(ScenePairs, DisabledPairsAreListedAndNotEnabled) {
  const Scene scene =
      load(abc +
           "pairs:\n  - {between: ['*', '*'], enabled: false}\n  - {between: [a, b], enabled: true}\n"
           "  - {between: [b, c], enabled: true}\ndisable:\n  - [c, b]\n");
  EXPECT_EQ(pairNames(scene), Names({"a/b", "b/c", "a/c"}));
  EXPECT_TRUE(allPairs(scene)[0].enabled);
  EXPECT_FALSE(allPairs(scene)[1].enabled);
  EXPECT_FALSE(allPairs(scene)[2].enabled);
}

TEST_F(ScenePairs, DisablingWhatIsNotWatchedIsNoted) {
  const Scene scene = load(abc + "pairs: [{between: [a, b]}]\ndisable:\n  - [a, c]\n");
  EXPECT_EQ(pairNames(scene), Names({"a/b"}));
  EXPECT_TRUE(hasNote(scene, "scene.yaml:8, disable[0][0]: disables no watched pair"));
}

TEST_F(ScenePairs, FilteredPairsAreWatchedOnlyWhenBothBodiesAreNamed) {
  EXPECT_EQ(pairNames(load(robot_scene + "pairs: [{between: ['[bat]*', '[bat]*']}]\n")),
            Names({"base/tool", "base/table", "arm/table", "tool/table"}));
  const Scene scene = load(robot_scene + "pairs: [{between: [base, arm]}]\n");
  EXPECT_EQ(pairNames(scene), Names({"base/arm"}));
  EXPECT_TRUE(hasNote(scene, "named, so watched in spite of: adjacent links"));
}

TEST_F(ScenePairs, BodiesInOneFrameAreNotWatchedAgainstEachOther) {
  const Scene scene = load(
      "defaults: {max_edge_length: 100}\n"
      "bodies:\n"
      "  - {name: a, frame: world, box: {size: [1, 1, 1]}}\n  - {name: b, frame: world, box: {size: [1, 1, "
      "1]}}\n"
      "  - {name: c, frame: cart, box: {size: [1, 1, 1]}}\n");
  EXPECT_EQ(pairNames(scene), Names({"a/c", "b/c"}));
  EXPECT_TRUE(hasNote(scene, "1 pair left out: no joint moves one against the other"));
}

TEST_F(ScenePairs, APairWithALinkWithoutGeometryIsAProblem) {
  const Scene scene =
      load(robot_scene + "pairs:\n  - between: [flange, table]\n  - between: [base, table]\n");
  EXPECT_EQ(pairNames(scene), Names({"base/table"}));
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_EQ(scene.problems[0].where, "scene.yaml:7, pairs[0].between[0]");
  EXPECT_TRUE(mentions(scene.problems[0].message, "'flange' is a link without geometry"));
}

TEST_F(ScenePairs, APairOfNothingButLinksWithoutGeometryIsNoted) {
  const Scene scene = load(robot_scene + "pairs:\n  - between: ['fl*', table]\n");
  EXPECT_TRUE(allPairs(scene).empty());
  EXPECT_TRUE(hasNote(scene, "scene.yaml:7, pairs[0].between[0]: gives no pair"));
}

TEST_F(ScenePairs, NamesAreUsableInTopicsAndStayApart) {
  const Scene scene =
      load(bodies({"a", "hook.1", "hook-1", "hook_1"}) + "pairs: [{between: [a, 'hook*']}]\n");
  EXPECT_EQ(pairNames(scene), Names({"a/hook_1", "a/hook_1_2", "a/hook_1_3"}));
}

TEST_F(ScenePairs, AGivenNameIsNotTakenByAGeneratedOne) {
  EXPECT_EQ(pairNames(load(abc + "pairs:\n  - {between: ['*', '*']}\n  - {between: [b, c], name: a/b}\n")),
            Names({"a/b", "a/b_2", "a/c"}));
}

TEST_F(ScenePairs, BodiesThatFailTakeTheirPairsWithThemAndTheOthersKeepTheirNames) {
  const Scene scene = load(bodies({"a", "hook.1", "missing", "hook-1"}) + "groups: {g: [missing]}\n");
  EXPECT_EQ(pairNames(scene), Names({"a/hook_1", "a/hook_1_2", "hook_1/hook_1_2"}));
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_TRUE(mentions(scene.problems[0].where, "scene.yaml:5, bodies[2]"));
  EXPECT_TRUE(
      mentions(scene.problems[0].message, "pairs not served: a/missing, hook_1/missing, missing/hook_1_2"))
      << scene.problems[0].message;
  // Indices point at the bodies that are there.
  for (const ScenePair& pair : allPairs(scene)) {
    ASSERT_LT(pair.body_a, scene.bodies.size());
    ASSERT_LT(pair.body_b, scene.bodies.size());
  }
  EXPECT_EQ(pairOf(scene, 2, 0)->name, "a/hook_1_2");
  EXPECT_EQ(findPairNamed(scene, "hook_1/hook_1_2")->body_b, 2U);
  EXPECT_FALSE(findPairNamed(scene, "missing/a"));
  EXPECT_EQ(scene.findBody("hook-1"), std::optional<std::size_t>(2));
  EXPECT_EQ(scene.findBody("missing"), std::nullopt);
}

TEST_F(ScenePairs, ALongListOfLostPairsSaysHowManyMore) {
  Names names = {"missing"};
  for (int i = 0; i < 14; ++i) names.push_back("b" + std::to_string(i));
  const Scene scene = load(bodies(names) + "pairs: [{between: [missing, '*']}]\n");
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_TRUE(mentions(scene.problems[0].message, "missing/b9 and 4 more")) << scene.problems[0].message;
}

TEST_F(ScenePairs, MoreThanAThousandWithoutACutoffGetOneAndNamedOnesDoNot) {
  Names names;
  for (int i = 0; i < 45; ++i) names.push_back("b" + std::to_string(i));
  const std::string few = bodies(names);  // 990 pairs
  EXPECT_TRUE(std::isinf(load(few).defaults.pairs.tracker.cutoff));
  names.push_back("b45");
  const Scene many = load(bodies(names) +
                          "pairs: [{between: ['*', '*']}, {between: ['b1*', b2], warning_distance: 1},"
                          " {between: [b0, b1]}]\n");
  EXPECT_EQ(many.pairs.size(), 1U);
  EXPECT_TRUE(std::isinf(many.pairs[0].settings.tracker.cutoff));
  EXPECT_NEAR(ruledPair(many, 3, 4)->settings.tracker.cutoff, 0.35, 1e-12)
      << "a fifth of the root of 3, two digits";
  EXPECT_EQ(ruledPair(many, 1, 2)->settings.tracker.cutoff, 1.0) << "an alert needs the distance";
  EXPECT_TRUE(hasNote(many, "cutoff 0.35 m of the pairs without one, because there are 1034"));
  EXPECT_FALSE(hasNote(load(bodies(names) + "pairs: [{between: ['*', '*'], cutoff: 9}]\n"),
                       "of the pairs without one"));
}

TEST_F(ScenePairs, GroupsAndDefaultsStayWithTheSceneForBodiesThatComeLater) {
  const Scene scene = load(
      "robots: [{description: robot, name: links}]\ndefaults: {max_edge_length: 100, chord_error: 0.5,\n"
      "  cutoff: 1.5, warning_distance: 0.25, material: {youngs_modulus: 1e6}}\n"
      "bodies: [{name: missing, mesh: missing.stl}, {name: table, box: {size: [1, 1, 1]}}]\n"
      "groups: {room: [missing, table], all: [room, arm, t*]}\n");
  EXPECT_EQ(scene.groups.at("links"), Names({"base", "arm", "tool"}));
  EXPECT_EQ(scene.groups.at("room"), Names({"missing", "table"}));
  EXPECT_EQ(scene.groups.at("all"), Names({"missing", "table", "arm", "tool"}));
  EXPECT_EQ(scene.defaults.pairs.tracker.cutoff, 1.5);
  EXPECT_EQ(scene.defaults.pairs.warning_distance, 0.25);
  EXPECT_EQ(scene.defaults.max_edge_length, 100.0);
  EXPECT_EQ(scene.defaults.chord_error, 0.5);
  EXPECT_EQ(scene.defaults.material.youngs_modulus, 1e6);
}

}  // namespace
}  // namespace concave_distance::scene_pairs_test
