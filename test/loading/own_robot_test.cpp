// A robot without a scene file gets meshes that are looked for beside its URDF, a cutoff of its size, a note
// about links that always overlap, and a preparation that can be watched and stopped.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_fixture.h"

namespace concave_distance::own_robot_test {
namespace {

using test::bodyNames;
using test::boxLink;
using test::hasNote;
using test::joint;
using test::mentions;
using test::pairNames;
using test::robot;

using Names = std::vector<std::string>;

std::string jointAt(const std::string& type, const std::string& parent, const std::string& child, double x) {
  return "<joint name='" + parent + "_" + child + "' type='" + type + "'><origin xyz='" + std::to_string(x) +
         " 0 0'/><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 0 1'/><limit lower='-0.01' upper='0.01' effort='1' velocity='1'/></joint>";
}

std::string meshLink(const std::string& name, const std::string& file) {
  return "<link name='" + name + "'><collision><geometry><mesh filename='" + file +
         "'/></geometry></collision></link>";
}

// Boxes of edge 1 in a row; each joint turns by a hundredth of a radian at most.
std::string row(double ab, double bc, double cd) {
  return robot(boxLink("a") + boxLink("b") + boxLink("c") + boxLink("d") + jointAt("revolute", "a", "b", ab) +
               jointAt("revolute", "b", "c", bc) + jointAt("revolute", "c", "d", cd));
}

class OwnRobot : public test::SceneTest {
 protected:
  Scene loadAlone(const std::string& urdf) { return loadRobotScene(urdf, "robot_description", options); }
};

TEST_F(OwnRobot, MeshesOfAnUnknownPackageAreFoundBelowTheSearchPath) {
  folder.write("data/meshes/t.stl", test::tetrahedronStl());
  folder.write("data/flat.stl", test::tetrahedronStl());
  folder.write("data/arm.urdf", "only its folder counts");
  const std::string urdf =
      robot(meshLink("deep", "package://unknown/meshes/t.stl") +
            meshLink("flat", "package://unknown/meshes_v3/flat.stl") + meshLink("relative", "meshes/t.stl") +
            joint("revolute", "deep", "flat") + joint("revolute", "flat", "relative"));
  EXPECT_EQ(loadAlone(urdf).problems.size(), 3U);
  for (const char* place : {"data", "data/arm.urdf"}) {
    options.mesh_search_path = {folder.path("elsewhere"), folder.path(place)};
    const Scene scene = loadAlone(urdf);
    EXPECT_TRUE(scene.problems.empty()) << place << ": " << scene.problems.front().message;
    EXPECT_EQ(bodyNames(scene), Names({"deep", "flat", "relative"}));
    EXPECT_FALSE(scene.bodies.front().in_robot_model) << "rviz does not find its mesh";
    EXPECT_TRUE(hasNote(scene, "was found below"));
  }
}

// As in the repositories of Fetch, ABB and UR, whose URDFs stand beside the folder of the meshes.
TEST_F(OwnRobot, MeshesAreFoundInFoldersBesideThatOfTheUrdf) {
  folder.write("src/arm_description/urdf/arm.urdf", "only its folder counts");
  folder.write("src/arm_description/meshes/link/t.stl", test::tetrahedronStl());
  folder.write("src/arm_description/stray.stl", test::tetrahedronStl());
  folder.write("src/gripper_description/meshes/t.stl", test::tetrahedronStl());
  options.mesh_search_path = {folder.path("src/arm_description/urdf/arm.urdf")};
  const Scene scene = loadAlone(robot(meshLink("own", "package://renamed/meshes/link/t.stl") +
                                      meshLink("other", "package://gripper_description/meshes/t.stl") +
                                      meshLink("stray", "package://arm/meshes/stray.stl") +
                                      joint("revolute", "own", "other") + joint("revolute", "own", "stray")));
  EXPECT_EQ(bodyNames(scene), Names({"own", "other"}));
  ASSERT_EQ(scene.problems.size(), 1U) << "a file name alone is not looked for above the URDF's folder";
  EXPECT_TRUE(mentions(scene.problems[0].where, "stray")) << scene.problems[0].where;
}

TEST_F(OwnRobot, AMeshNamedWithItsPackageIsPreferredToANearerOneOfThatName) {
  folder.write("src/arm/urdf/arm.urdf", "only its folder counts");
  folder.write("src/arm/meshes/t.stl", "not a mesh");
  folder.write("src/gripper/meshes/t.stl", test::tetrahedronStl());
  options.mesh_search_path = {folder.path("src/arm/urdf/arm.urdf")};
  const Scene scene = loadAlone(robot(meshLink("a", "package://gripper/meshes/t.stl")));
  EXPECT_TRUE(scene.problems.empty()) << scene.problems.front().message;
}

TEST_F(OwnRobot, AMeshThatIsNowhereNamesTheFoldersThatWereTried) {
  options.mesh_search_path = {folder.path("data")};
  const Scene scene = loadAlone(robot(meshLink("a", "package://unknown/meshes/t.stl")));
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_TRUE(mentions(scene.problems[0].message, "package 'unknown' is not known"))
      << scene.problems[0].message;
  EXPECT_TRUE(mentions(scene.problems[0].message, "mesh_search_path")) << scene.problems[0].message;
}

TEST_F(OwnRobot, ASearchPathDoesNotReplaceAPackageThatIsKnown) {
  folder.write("meshes/t.stl", test::tetrahedronStl());
  folder.write("data/meshes/t.stl", "not a mesh");
  options.mesh_search_path = {folder.path("data")};
  const Scene scene = loadAlone(robot(meshLink("a", "package://arm_description/meshes/t.stl")));
  EXPECT_TRUE(scene.problems.empty());
  EXPECT_TRUE(scene.bodies.front().in_robot_model);
}

TEST_F(OwnRobot, AutomaticCutoffIsAFifthOfTheRobotsDiagonal) {
  // 10 x 1 x 1: the origins of the outer boxes are 9 apart.
  const std::string urdf = row(3.0, 3.0, 3.0);
  EXPECT_TRUE(std::isinf(allPairs(loadAlone(urdf)).front().settings.tracker.cutoff)) << "only when asked for";
  options.automatic_cutoff = true;
  const Scene scene = loadAlone(urdf);
  const double wanted = 0.2 * std::sqrt(102.0);
  ASSERT_TRUE(scene.automatic_cutoff);
  EXPECT_GE(*scene.automatic_cutoff, wanted - 1e-9);
  EXPECT_LE(*scene.automatic_cutoff, 1.1 * wanted) << "rounded up to two digits";
  for (const ScenePair& pair : allPairs(scene)) {
    EXPECT_EQ(pair.settings.tracker.cutoff, *scene.automatic_cutoff);
  }
  EXPECT_TRUE(hasNote(scene, "fifth of the robot's diagonal"));
}

TEST_F(OwnRobot, PairsThatOverlapInEveryPoseAreNamedAndLeftOutOnlyOnRequest) {
  // a and c overlap by half of their length although b is between them; a and d do not.
  const std::string urdf = row(0.25, 0.25, 3.0);
  Scene scene = loadAlone(urdf);
  EXPECT_EQ(pairNames(scene), Names({"a/c", "a/d", "b/d"}));
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_TRUE(mentions(scene.warnings[0], "1 pair overlaps")) << scene.warnings[0];
  EXPECT_TRUE(mentions(scene.warnings[0], "always 0: a/c. ")) << scene.warnings[0];
  options.skip_overlapping_pairs = true;
  scene = loadAlone(urdf);
  EXPECT_EQ(pairNames(scene), Names({"a/d", "b/d"}));
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(hasNote(scene, "left out"));
}

TEST_F(OwnRobot, APairThatOverlapsInTheZeroPoseAloneIsNotNamed) {
  // c is turned about b's far corner: most poses take it out of a.
  const std::string turning =
      "<joint name='b_c' type='continuous'><origin xyz='0 -3 0'/><parent link='b'/><child link='axis'/>"
      "<axis xyz='0 0 1'/></joint><link name='axis'/>"
      "<joint name='arm' type='fixed'><origin xyz='0 3 0'/><parent link='axis'/><child link='c'/></joint>";
  const Scene scene = loadAlone(
      robot(boxLink("a") + boxLink("b") + boxLink("c") + jointAt("revolute", "a", "b", 0.25) + turning));
  EXPECT_EQ(pairNames(scene), Names({"a/c"}));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST_F(OwnRobot, ARobotWithoutGeometryOfTheWantedKindSaysSo) {
  const std::string urdf =
      robot("<link name='a'><visual><geometry><box size='1 1 1'/></geometry></visual></link>");
  const Scene scene = loadAlone(urdf);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_TRUE(mentions(scene.warnings[0], "no link of the robot has collision geometry"))
      << scene.warnings[0];
  EXPECT_TRUE(mentions(scene.warnings[0], "1 link with visual geometry")) << scene.warnings[0];
  options.geometry = GeometrySource::Visual;
  EXPECT_TRUE(loadAlone(urdf).warnings.empty());
}

TEST_F(OwnRobot, FixedJointsJoinFramesAndLinksAreKnownAsLinks) {
  const Scene scene = loadAlone(robot(boxLink("a") + boxLink("b") + boxLink("c") + joint("fixed", "a", "b") +
                                      joint("revolute", "b", "c")));
  EXPECT_TRUE(scene.rigid.areJoined("a", "b"));
  EXPECT_FALSE(scene.rigid.areJoined("a", "c"));
  EXPECT_TRUE(scene.bodies.front().is_robot_link);
}

TEST_F(OwnRobot, FloatingJointsAreNotedBecauseRobotStatePublisherLeavesThemOut) {
  const Scene scene = loadAlone(robot(boxLink("a") + boxLink("b") + boxLink("c") +
                                      joint("floating", "a", "b") + joint("revolute", "b", "c")));
  EXPECT_TRUE(hasNote(scene, "floats, so robot_state_publisher leaves out the transform from 'a' to 'b'"));
  EXPECT_FALSE(hasNote(scene, "from 'b' to 'c'"));
}

TEST_F(OwnRobot, TheChordErrorIsThatOfTheMeshesOfRoundLinks) {
  const std::string urdf =
      robot("<link name='a'><collision><geometry><sphere radius='1'/></geometry></collision></link>");
  const auto triangles = [&] { return loadAlone(urdf).bodies.at(0).mesh->surface().triangleCount(); };
  const std::size_t usual = triangles();
  options.chord_error = 0.1;  // instead of 1 % of the radius
  const std::size_t coarse = triangles();
  EXPECT_LT(4 * coarse, usual);
  options.chord_error = 0.01;
  EXPECT_EQ(triangles(), usual);
}

TEST_F(OwnRobot, PreparationIsCountedAndStops) {
  LoadProgress progress;
  options.progress = &progress;
  EXPECT_EQ(loadAlone(row(3.0, 3.0, 3.0)).bodies.size(), 4U);
  EXPECT_EQ(progress.bodies(), 4U);
  EXPECT_EQ(progress.prepared(), 4U);
  LoadProgress stopped;
  stopped.stop = true;
  options.progress = &stopped;
  EXPECT_TRUE(loadAlone(row(3.0, 3.0, 3.0)).bodies.empty());
}

TEST_F(OwnRobot, LinksDisabledByDefaultInTheSrdfAreWatchedWhereItEnablesThem) {
  options.descriptions["robot_description_semantic"] =
      "<robot name='arm'><disable_default_collisions link='d'/><enable_collisions link1='a' link2='d'/>"
      "<disable_collisions link1='a' link2='c' reason='Never'/></robot>";
  EXPECT_EQ(pairNames(loadAlone(row(3.0, 3.0, 3.0))), Names({"a/d"}));
}

// The KUKA KR5 with an SRDF as MoveIt's setup assistant writes one.
TEST_F(OwnRobot, AnSrdfOfMoveItLeavesThePairsThatItDoesNotDisable) {
  const std::string source = CONCAVE_DISTANCE_SOURCE_DIR;
  options.package_locator = [&](const std::string&) { return source; };
  const std::string urdf = test::contentOf(source + "/urdf/kr5.urdf");
  EXPECT_EQ(allPairs(loadAlone(urdf)).size(), 15U) << "21 pairs of 7 links, 6 of them adjacent";
  options.descriptions["robot_description_semantic"] = test::contentOf(source + "/test/data/srdf/kr5.srdf");
  const Scene scene = loadAlone(urdf);
  EXPECT_EQ(allPairs(scene).size(), 10U) << "5 that are not adjacent are disabled";
  EXPECT_FALSE(scene.findPair("forearm", "palm"));
  EXPECT_TRUE(scene.problems.empty());
}

}  // namespace
}  // namespace concave_distance::own_robot_test
