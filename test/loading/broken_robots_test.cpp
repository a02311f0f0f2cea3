// Robots whose description cannot be read: what is refused and what is served all the same.
#include <gtest/gtest.h>

#include "support/scene_fixture.h"

namespace concave_distance::broken_robots_test {
namespace {

using test::bareLink;
using test::boxLink;
using test::joint;
using test::mentions;
using test::pairNames;
using test::robot;

using Names = std::vector<std::string>;

std::string robotRefusal(const std::string& urdf) {
  try {
    static_cast<void>(loadRobotScene(urdf, "robot_description", SceneLoadOptions{}));
    return "accepted";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(BrokenUrdf, IsRefusedWithItsNameAndWhatTheParsersSay) {
  const std::string folder = CONCAVE_DISTANCE_TEST_DATA "/invalid";
  EXPECT_TRUE(mentions(robotRefusal(test::contentOf(folder + "/invalid.urdf")),
                       "robot_description: the URDF cannot be read; line 1: XML_ERROR_PARSING_TEXT"));
  EXPECT_TRUE(mentions(robotRefusal(""), "XML_ERROR_EMPTY_DOCUMENT"));
  EXPECT_TRUE(mentions(robotRefusal("<robot name='r'>\n<link name='a'>\n</robot>"),
                       "line 2: XML_ERROR_MISMATCHED_ELEMENT"));
  EXPECT_TRUE(mentions(robotRefusal("<robot><link name='a'/></robot>"), "No name given for the robot"));
  EXPECT_TRUE(mentions(robotRefusal("<robot name='r'/>"), "No link elements found"));
  EXPECT_TRUE(mentions(robotRefusal("<world name='w'/>"), "Could not find the 'robot' element"));
  EXPECT_TRUE(mentions(robotRefusal(robot(bareLink("a") + bareLink("a"))), "link 'a' is not unique"));
  EXPECT_TRUE(mentions(robotRefusal(robot(bareLink("a") + bareLink("b"))), "Two root links found"));
  EXPECT_TRUE(mentions(robotRefusal(robot(bareLink("a") + joint("fixed", "a", "zz"))), "[zz]"));
}

// urdfdom's own parser, and its model of a chain of links, once used up the stack.
TEST(BrokenUrdf, IsRefusedHoweverDeepOrLongItIs) {
  const auto repeated = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
  };
  EXPECT_TRUE(mentions(robotRefusal("<robot name='r'>" + repeated("<link>", 300'000)), "DEPTH_EXCEEDED"));
  EXPECT_TRUE(mentions(robotRefusal(repeated("<a>", 1'000'000)), "DEPTH_EXCEEDED"));
  EXPECT_TRUE(mentions(robotRefusal("<robot name='r' name='r'>" + repeated("<a>", 300'000)), "line 1"));
  std::string chain = bareLink("l0");
  for (int i = 1; i <= 200'000; ++i) {
    chain += bareLink("l" + std::to_string(i));
    chain += joint("fixed", "l" + std::to_string(i - 1), "l" + std::to_string(i));
  }
  EXPECT_TRUE(mentions(robotRefusal(robot(chain)), "200001 links"));
  const std::string comment = "<!--" + std::string(64'000'000, ' ') + "-->";
  EXPECT_TRUE(mentions(robotRefusal(comment), "64000007 bytes"));
}

class SceneOfBrokenRobots : public test::SceneTest {
 protected:
  // A scene of that robot and two boxes; the problem of the robot, which is the first.
  SceneProblem firstProblem(const std::string& entry, const std::string& pairs = "") {
    last_scene = load("defaults: {max_edge_length: 9}\nrobots:\n  - " + entry +
                      "\nbodies:\n  - {name: c, box: {size: [1, 1, 1]}}\n"
                      "  - {name: d, box: {size: [1, 1, 1]}}\n" +
                      pairs);
    return last_scene.problems.empty() ? SceneProblem{"none", "none"} : last_scene.problems.front();
  }
  Scene last_scene;
};

TEST_F(SceneOfBrokenRobots, ServesTheRestAndNamesTheFileAndWhatIsWrong) {
  const std::string file = CONCAVE_DISTANCE_TEST_DATA "/invalid/invalid.urdf";
  const SceneProblem problem = firstProblem("{urdf: " + file + "}");
  EXPECT_EQ(problem.where, file);
  EXPECT_TRUE(mentions(problem.message, "the URDF cannot be read")) << problem.message;
  EXPECT_TRUE(mentions(problem.message, "no link of this robot is served")) << problem.message;
  EXPECT_EQ(pairNames(last_scene), Names({"c/d"}));
  EXPECT_TRUE(mentions(firstProblem("{urdf: gone.urdf}").where, "scene.yaml:3, robots[0], gone.urdf"));
  EXPECT_TRUE(mentions(firstProblem("{urdf: 'package://gone/a.urdf'}").message, "package 'gone'"));
}

TEST_F(SceneOfBrokenRobots, TellsPairsOfItsLinksAndRefusesUnknownNamesOnlyWhereEveryRobotIsRead) {
  const std::string pairs =
      "groups: {hand: ['finger*']}\n"
      "pairs:\n  - between: [c, wrist]\n  - between: [c, d]\n  - between: [d, hand]\n";
  firstProblem("{urdf: gone.urdf}", pairs);
  EXPECT_EQ(pairNames(last_scene), Names({"c/d"}));
  ASSERT_EQ(last_scene.problems.size(), 2U);
  EXPECT_EQ(last_scene.problems[1].where, "scene.yaml:9, pairs[0].between[0]");
  EXPECT_TRUE(mentions(last_scene.problems[1].message, "'wrist' is not known, perhaps"))
      << last_scene.problems[1].message;
  folder.write("whole.urdf", robot(boxLink("a")));
  EXPECT_THROW(firstProblem("{urdf: whole.urdf}", pairs), Error);
}

TEST_F(SceneOfBrokenRobots, ServesARobotWhoseSrdfCannotBeRead) {
  folder.write("arm.urdf", robot(boxLink("a")));
  folder.write("arm.srdf", "This is not an SRDF.");
  for (const std::string srdf : {"arm.srdf", "gone.srdf"}) {
    const SceneProblem problem = firstProblem("{urdf: arm.urdf, srdf: " + srdf + "}");
    EXPECT_TRUE(mentions(problem.where, srdf)) << problem.where;
    EXPECT_TRUE(mentions(problem.message, "no pair is disabled by it")) << problem.message;
    EXPECT_EQ(pairNames(last_scene), Names({"a/c", "a/d", "c/d"}));
  }
}

TEST(BrokenUrdf, InvalidMeshFileIsAProblemAndNoError) {
  const std::string file = CONCAVE_DISTANCE_TEST_DATA "/invalid/invalid_mesh.urdf";
  SceneLoadOptions options;
  options.geometry = GeometrySource::Visual;
  const Scene scene = loadRobotScene(test::contentOf(file), file, options);
  EXPECT_TRUE(scene.bodies.empty());
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_TRUE(mentions(scene.problems[0].message, "invalid_mesh.stl")) << scene.problems[0].message;
}

}  // namespace
}  // namespace concave_distance::broken_robots_test
