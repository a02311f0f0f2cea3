#include <gtest/gtest.h>

#include <array>

#include "support/scene_fixture.h"

namespace concave_distance::robot_scene_test {
namespace {

using test::bareLink;
using test::bodyNames;
using test::boxLink;
using test::hasNote;
using test::joint;
using test::mentions;
using test::pairNames;
using test::robot;
using test::signedVolume;

using Names = std::vector<std::string>;

class RobotScene : public test::SceneTest {
 protected:
  static std::string collision(const std::string& geometry, const std::string& origin = "") {
    return "<collision>" + origin + "<geometry>" + geometry + "</geometry></collision>";
  }
  const SurfaceMesh& onlySurface(const std::string& link_content, const std::string& more_of_robot = "") {
    last_scene = loadRobot(robot("<link name='base'>" + link_content + "</link>"), more_of_robot);
    if (last_scene.bodies.size() != 1) {
      throw std::runtime_error(last_scene.problems.empty() ? "no body" : last_scene.problems.front().message);
    }
    return last_scene.bodies.front().mesh->surface();
  }
  std::string onlyProblem(const std::string& link_content) {
    last_scene = loadRobot(robot("<link name='base'>" + link_content + "</link>"));
    return last_scene.problems.size() == 1 && last_scene.bodies.empty() ? last_scene.problems.front().message
                                                                        : "no single problem";
  }
  static void expectBox(const SurfaceMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    EXPECT_LT((mesh.boundingBox().min() - low).norm(), 1e-12) << mesh.boundingBox().min().transpose();
    EXPECT_LT((mesh.boundingBox().max() - high).norm(), 1e-12) << mesh.boundingBox().max().transpose();
  }
  Scene last_scene;
};

TEST_F(RobotScene, CollisionElementsOfALinkAreOneBodyInTheLinksFrame) {
  const SurfaceMesh& mesh =
      onlySurface(collision("<box size='2 4 6'/>", "<origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/>") +
                  collision("<box size='1 1 1'/>", "<origin xyz='0 0 10'/>"));
  // The first box, turned a quarter about z, is 4 x 2 x 6 about (1, 0, 0).
  expectBox(mesh, {-1, -1, -3}, {3, 1, 10.5});
  EXPECT_EQ(mesh.triangleCount(), 24U);
  EXPECT_NEAR(signedVolume(mesh), 48.0 + 1.0, 1e-12);
  EXPECT_EQ(last_scene.bodies.front().repair.closed_shells, 2U);
  EXPECT_EQ(last_scene.bodies.front().name, "base");
  EXPECT_EQ(last_scene.bodies.front().frame, "base");
}

TEST_F(RobotScene, RollPitchYawTurnAboutFixedAxesInThisOrder) {
  // R = Rz(90) Ry(0) Rx(90) takes x to y, y to z, z to x.
  const SurfaceMesh& mesh = onlySurface(
      collision("<box size='2 4 6'/>", "<origin rpy='1.5707963267948966 0 1.5707963267948966'/>"));
  expectBox(mesh, {-3, -1, -2}, {3, 1, 2});
}

TEST_F(RobotScene, MeshScaleIsAppliedPerAxisBeforeTheOrigin) {
  folder.write("meshes/t.stl", test::tetrahedronStl());
  const SurfaceMesh& mesh =
      onlySurface(collision("<mesh filename='package://arm_description/meshes/t.stl' scale='2 3 0.5'/>",
                            "<origin xyz='10 20 30'/>"));
  expectBox(mesh, {10, 20, 30}, {12, 26, 31.5});
  EXPECT_NEAR(signedVolume(mesh), 3.0, 1e-9);
}

TEST_F(RobotScene, MirroringScaleKeepsNormalsOutwards) {
  folder.write("t.stl", test::tetrahedronStl());
  for (const char* scale : {"-1 1 1", "-1 -1 1", "1 1 -1", "-1 -1 -1"}) {
    const SurfaceMesh& mesh = onlySurface(
        collision("<mesh filename='package://arm_description/t.stl' scale='" + std::string(scale) + "'/>"));
    EXPECT_NEAR(signedVolume(mesh), 1.0, 1e-9) << scale;
  }
  expectBox(last_scene.bodies.front().mesh->surface(), {-1, -2, -3}, {0, 0, 0});
}

TEST_F(RobotScene, RoundPrimitivesSayHowFarTheirMeshIsOff) {
  const SurfaceMesh& mesh = onlySurface(collision("<sphere radius='2'/>"), "    chord_error: 0.1\n");
  for (const Eigen::Vector3d& vertex : mesh.vertices()) EXPECT_LE(vertex.norm(), 2.0 + 1e-12);
  EXPECT_TRUE(hasNote(last_scene, "sphere taken exactly; searched and drawn as a mesh, 0.1 m off at most"));
  onlySurface(collision("<cylinder radius='0.5' length='3'/>"));
  EXPECT_TRUE(
      hasNote(last_scene, "cylinder taken exactly; searched and drawn as a mesh, 0.005 m off at most"));
}

TEST_F(RobotScene, ALinkOfOneRoundElementIsThatSolid) {
  onlySurface(
      "<collision><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/><geometry>"
      "<cylinder radius='0.5' length='3'/></geometry></collision>");
  const SceneBody body = last_scene.bodies.front();
  const RoundShape* shape = body.mesh->shape();
  ASSERT_NE(shape, nullptr);
  EXPECT_EQ(shape->kind, RoundKind::Cylinder);
  EXPECT_EQ(shape->radius, 0.5);
  EXPECT_EQ(shape->half_length, 1.5);
  EXPECT_NEAR((shape->body_from_shape.translation() - Eigen::Vector3d(1, 2, 3)).norm(), 0.0, 1e-15);
  for (const Eigen::Vector3d& vertex : body.mesh->surface().vertices()) {
    const Eigen::Vector3d point = shape->body_from_shape.inverse() * vertex;
    EXPECT_LE(point.head<2>().norm(), 0.5 + 1e-12);
    EXPECT_LE(std::abs(point.z()), 1.5 + 1e-12);
  }
  onlySurface(collision("<cylinder radius='0.5' length='3'/>") + collision("<sphere radius='0.6'/>"));
  EXPECT_EQ(last_scene.bodies.front().mesh->shape(), nullptr);
  EXPECT_TRUE(hasNote(last_scene, "cylinder among several elements meshed from inside, 0.005 m off at most"));
  onlySurface(collision("<box size='1 1 1'/>"));
  EXPECT_EQ(last_scene.bodies.front().mesh->shape(), nullptr);
}

TEST_F(RobotScene, VisualGeometryIsTakenWhenAskedFor) {
  const std::string content =
      "<visual><geometry><box size='4 4 4'/></geometry></visual>" + collision("<box size='2 2 2'/>");
  expectBox(onlySurface(content), {-1, -1, -1}, {1, 1, 1});
  expectBox(onlySurface(content, "    geometry: visual\n"), {-2, -2, -2}, {2, 2, 2});
  options.geometry = GeometrySource::Visual;
  expectBox(onlySurface(content), {-2, -2, -2}, {2, 2, 2});
  expectBox(onlySurface(content, "    geometry: collision\n"), {-1, -1, -1}, {1, 1, 1});
}

TEST_F(RobotScene, ColourIsThatOfTheVisualElement) {
  const std::string material = "<material name='m'><color rgba='0.1 0.2 0.3 0.4'/></material>";
  onlySurface("<visual><geometry><box size='1 1 1'/></geometry>" + material + "</visual>" +
              collision("<box size='1 1 1'/>"));
  EXPECT_TRUE(last_scene.bodies.front().colour.isApprox(Eigen::Vector4d(0.1, 0.2, 0.3, 0.4), 1e-6));
  EXPECT_TRUE(last_scene.bodies.front().in_robot_model);
}

TEST_F(RobotScene, LinkWithoutGeometryIsNoBodyAndNoProblem) {
  const Scene scene = loadRobot(robot(bareLink("world") + boxLink("a") + joint("fixed", "world", "a")));
  EXPECT_EQ(bodyNames(scene), Names({"a"}));
  EXPECT_TRUE(scene.problems.empty());
  EXPECT_TRUE(hasNote(scene, "1 link with geometry, 1 without, 0 skipped"));
}

TEST_F(RobotScene, BodiesComeInTheOrderOfTheText) {
  const Scene scene = loadRobot(robot(boxLink("z") + boxLink("a") + boxLink("m") +
                                      joint("continuous", "a", "z") + joint("continuous", "z", "m")));
  EXPECT_EQ(bodyNames(scene), Names({"z", "a", "m"}));
}

TEST_F(RobotScene, LeadingSlashesOfLinkNamesAreDroppedAsRobotStatePublisherDoes) {
  const Scene scene = loadRobot(robot(boxLink("/a") + boxLink("/b") + joint("floating", "/a", "/b")));
  EXPECT_EQ(bodyNames(scene), Names({"a", "b"}));
  EXPECT_EQ(scene.bodies[1].frame, "b");
}

TEST_F(RobotScene, LinksAreTheSameWithAndWithoutALeadingSlash) {
  const std::string urdf = robot(boxLink("/a") + boxLink("/b") + boxLink("/c") +
                                 joint("floating", "/a", "/b") + joint("floating", "/b", "/c"));
  EXPECT_EQ(pairNames(loadRobot(urdf)), Names({"a/c"}));
  const std::string srdf = "<robot name='arm'><disable_collisions link1='a' link2='/c'/></robot>";
  EXPECT_EQ(pairNames(loadRobot(urdf, "", srdf)), Names());
  EXPECT_EQ(bodyNames(loadRobot(urdf, "    skip_links: [/b, c]\n")), Names({"a"}));
  const Scene twice = loadRobot(robot(boxLink("/a") + bareLink("a") + joint("fixed", "/a", "a")));
  ASSERT_EQ(twice.problems.size(), 1U);
  EXPECT_TRUE(mentions(twice.problems[0].message, "two links are called 'a'")) << twice.problems[0].message;
}

TEST_F(RobotScene, PrefixGoesBeforeNamesAndFrames) {
  const Scene scene = loadRobot(robot(boxLink("a") + boxLink("b") + boxLink("c") +
                                      joint("continuous", "a", "b") + joint("continuous", "b", "c")),
                                "    prefix: left/\n");
  EXPECT_EQ(bodyNames(scene), Names({"left/a", "left/b", "left/c"}));
  EXPECT_EQ(scene.bodies[0].frame, "left/a");
  EXPECT_EQ(pairNames(scene), Names({"left_a/left_c"}));
}

TEST_F(RobotScene, SkippedLinksAreNoBodiesButStillStandBetweenOthers) {
  const std::string urdf =
      robot(boxLink("a") + boxLink("b") + boxLink("c") + boxLink("sensor_1") + joint("continuous", "a", "b") +
            joint("continuous", "b", "c") + joint("continuous", "c", "sensor_1"));
  const Scene scene = loadRobot(urdf, "    skip_links: [b, 'sensor_*']\n");
  EXPECT_EQ(bodyNames(scene), Names({"a", "c"}));
  EXPECT_EQ(pairNames(scene), Names({"a/c"}));
  options.descriptions["robot_description"] = urdf;
  EXPECT_TRUE(mentions(refusal("robots:\n  - description: robot_description\n    skip_links: [a, elbow]\n"),
                       "scene.yaml:3, robots[0].skip_links[1]: 'elbow' matches no link of robot 'arm'"));
}

TEST_F(RobotScene, UrdfFileMayNameItsMeshesRelativeToItself) {
  folder.write("robots/meshes/upper arm.stl", test::tetrahedronStl());
  const std::string file = folder.write(
      "robots/arm.urdf",
      robot("<link name='a'>" + collision("<mesh filename='meshes/upper%20arm.stl'/>") + "</link>"));
  const Scene scene = load("defaults: {max_edge_length: 9}\nrobots: [{urdf: robots/arm.urdf}]");
  ASSERT_EQ(bodyNames(scene), Names({"a"}));
  EXPECT_FALSE(scene.bodies.front().in_robot_model);
  EXPECT_TRUE(mentions(scene.bodies.front().source, file));
}

TEST_F(RobotScene, ParentAndChildAreNotWatched) {
  const Scene scene = loadRobot(robot(boxLink("a") + boxLink("b") + boxLink("c") +
                                      joint("revolute", "a", "b") + joint("prismatic", "b", "c")));
  EXPECT_EQ(pairNames(scene), Names({"a/c"}));
  EXPECT_TRUE(hasNote(scene, "2 pairs left out: adjacent links"));
}

TEST_F(RobotScene, LinksWithoutGeometryOnFixedJointsAreSkippedThrough) {
  const Scene scene = loadRobot(
      robot(boxLink("a") + bareLink("flange") + bareLink("tool0") + boxLink("gripper") + boxLink("finger") +
            joint("revolute", "a", "flange") + joint("fixed", "flange", "tool0") +
            joint("fixed", "tool0", "gripper") + joint("prismatic", "gripper", "finger")));
  // The gripper turns against a about one joint, hence is its neighbour; the finger is not.
  EXPECT_EQ(pairNames(scene), Names({"a/finger"}));
}

TEST_F(RobotScene, SiblingsOnALinkWithoutGeometryAreAdjacentWhenOneJointMovesOnly) {
  const Scene scene =
      loadRobot(robot(bareLink("world") + boxLink("table") + boxLink("carriage") + boxLink("door") +
                      joint("fixed", "world", "table") + joint("prismatic", "world", "carriage") +
                      joint("revolute", "world", "door")));
  EXPECT_EQ(pairNames(scene), Names({"carriage/door"}));
}

TEST_F(RobotScene, TwoMovingJointsMakeNoNeighbours) {
  const Scene scene = loadRobot(robot(boxLink("a") + bareLink("cross") + boxLink("b") +
                                      joint("revolute", "a", "cross") + joint("revolute", "cross", "b")));
  EXPECT_EQ(pairNames(scene), Names({"a/b"}));
}

TEST_F(RobotScene, ALinkWithGeometryIsNotSkippedThrough) {
  const Scene scene = loadRobot(robot(boxLink("a") + boxLink("b") + boxLink("c") + joint("fixed", "a", "b") +
                                      joint("revolute", "b", "c")));
  EXPECT_EQ(pairNames(scene), Names({"a/c"}));
  EXPECT_TRUE(hasNote(scene, "1 pair left out: no joint moves one against the other"));
}

TEST_F(RobotScene, BodiesFixedToTheSameRigidPartAreNotWatched) {
  options.descriptions["robot_description"] =
      robot(boxLink("wrist") + bareLink("tool0") + boxLink("base") + joint("revolute", "base", "wrist") +
            joint("fixed", "wrist", "tool0"));
  const Scene scene = load(
      "robots: [{description: robot_description, max_edge_length: 9}]\n"
      "bodies: [{name: cup, frame: tool0, box: {size: [1, 1, 1]}, max_edge_length: 9}]\n");
  EXPECT_EQ(pairNames(scene), Names({"base/cup"}));
}

TEST_F(RobotScene, SrdfDisablesPairs) {
  const std::string urdf =
      robot(boxLink("a") + boxLink("b") + boxLink("c") + boxLink("d") + joint("continuous", "a", "b") +
            joint("continuous", "b", "c") + joint("continuous", "c", "d"));
  EXPECT_EQ(pairNames(loadRobot(urdf)), Names({"a/c", "a/d", "b/d"}));
  const Scene scene = loadRobot(
      urdf, "", "<robot name='arm'><disable_collisions link1='d' link2='a' reason='Never'/></robot>");
  EXPECT_EQ(pairNames(scene), Names({"a/c", "b/d"}));
  EXPECT_TRUE(hasNote(scene, "1 pair left out: disabled in the SRDF"));
}

TEST_F(RobotScene, SrdfIsReadFromAFileAndForARobotWithPrefix) {
  options.descriptions["robot_description"] =
      robot(boxLink("a") + bareLink("x") + boxLink("b") + joint("continuous", "a", "x") +
            joint("continuous", "x", "b"));
  folder.write("arm.srdf", "<robot name='arm'><disable_collisions link1='a' link2='b'/></robot>");
  const Scene scene =
      load("robots: [{description: robot_description, srdf: arm.srdf, prefix: l_, max_edge_length: 9}]");
  EXPECT_TRUE(allPairs(scene).empty());
  EXPECT_EQ(scene.bodies.size(), 2U);
}

TEST_F(RobotScene, SrdfGroupsAreGroupsOfTheScene) {
  const std::string urdf = robot(boxLink("a") + boxLink("b") + boxLink("c") + boxLink("d") + boxLink("e") +
                                 joint("continuous", "a", "b") + joint("continuous", "b", "c") +
                                 joint("continuous", "c", "d") + joint("continuous", "d", "e"));
  const std::string srdf =
      "<robot name='arm'>"
      "<group name='chain'><chain base_link='b' tip_link='d'/></group>"
      "<group name='joints'><joint name='d_e'/><joint name='virtual'/></group>"
      "<group name='both'><group name='joints'/><link name='a'/></group></robot>";
  EXPECT_EQ(pairNames(loadRobot(urdf, "pairs: [{between: [a, chain]}]\n", srdf)), Names({"a/c", "a/d"}));
  EXPECT_EQ(pairNames(loadRobot(urdf, "pairs: [{between: [both, both]}]\n", srdf)), Names({"a/e"}));
  EXPECT_TRUE(hasNote(loadRobot(urdf, "", srdf), "joint 'virtual' is not a joint of the URDF"));
}

TEST_F(RobotScene, WhatTheSrdfHasAndTheUrdfHasNotIsNoted) {
  const Scene scene = loadRobot(robot(boxLink("a")), "",
                                "<robot name='arm'>\n<disable_collisions link1='a' link2='gone'/>\n"
                                "<enable_collisions link1='a' link2='gone'/></robot>");
  EXPECT_TRUE(hasNote(scene, "parameter semantics:2: disable_collisions names 'gone'"));
  EXPECT_TRUE(hasNote(scene, "parameter semantics:3: enable_collisions names 'gone'"));
}

// A pair disabled by mistake would not be watched, and nobody would notice.
TEST_F(RobotScene, TheSrdfOfAnotherRobotIsNotAppliedOrAppliedWithAWarning) {
  const std::string urdf = robot(boxLink("a") + boxLink("b") + boxLink("c") + joint("floating", "a", "b") +
                                 joint("floating", "b", "c"));
  const std::string disables = "<disable_collisions link1='a' link2='c'/>";
  const std::string unknown = "<disable_collisions link1='a' link2='gone'/>";
  const Scene renamed = loadRobot(urdf, "", "<robot name='other'>" + disables + "</robot>");
  EXPECT_TRUE(allPairs(renamed).empty());
  EXPECT_TRUE(renamed.problems.empty());
  ASSERT_EQ(renamed.warnings.size(), 1U);
  EXPECT_TRUE(mentions(renamed.warnings[0], "parameter semantics: it is for robot 'other', read for 'arm'"));
  for (const std::string& srdf :
       {"<robot name='other'>" + disables + unknown + "</robot>",
        "<robot name='arm'><group name='g'><link name='x'/></group></robot>" + std::string()}) {
    const Scene scene = loadRobot(urdf, "", srdf);
    EXPECT_EQ(pairNames(scene), Names({"a/c"})) << srdf;
    ASSERT_EQ(scene.problems.size(), 1U) << srdf;
    EXPECT_TRUE(mentions(scene.problems[0].message, "it is the SRDF of robot")) << scene.problems[0].message;
  }
  EXPECT_TRUE(allPairs(loadRobot(urdf, "", "<robot name='arm'>" + disables + unknown + "</robot>")).empty());
}

TEST_F(RobotScene, BrokenSrdfIsAProblemAndTheRobotIsServedWithoutIt) {
  for (const std::string srdf : {"<robot name='arm'>", "<model/>"}) {
    const Scene scene = loadRobot(robot(boxLink("a")), "", srdf);
    EXPECT_EQ(bodyNames(scene), Names({"a"}));
    ASSERT_EQ(scene.problems.size(), 1U);
    EXPECT_EQ(scene.problems[0].where, "parameter semantics");
    EXPECT_TRUE(mentions(scene.problems[0].message, "no pair is disabled by it"))
        << scene.problems[0].message;
  }
}

TEST_F(RobotScene, UnknownOrBrokenGeometryIsAProblemOfItsLinkAlone) {
  for (const std::string geometry : {"<cone radius='1'/>", "<box size='1 1'/>", "<box size='1 x 1'/>",
                                     "<sphere radius='r'/>", "<mesh/>", ""}) {
    const Scene scene =
        loadRobot(robot("<link name='bad'>" + collision("<box size='1 1 1'/>") + collision(geometry) +
                        "</link>" + boxLink("good") + joint("floating", "bad", "good")));
    EXPECT_EQ(bodyNames(scene), Names({"good"})) << geometry;
    ASSERT_EQ(scene.problems.size(), 1U) << geometry;
    EXPECT_TRUE(mentions(scene.problems[0].where, "link 'bad'")) << scene.problems[0].where;
    EXPECT_TRUE(mentions(scene.problems[0].message, "urdfdom read 1 of 2 collision elements: "))
        << scene.problems[0].message;
  }
  EXPECT_TRUE(mentions(onlyProblem(collision("<cone radius='1'/>")), "Unknown geometry type 'cone'"));
}

TEST_F(RobotScene, SizesThatMakeNoBodyAreProblems) {
  EXPECT_TRUE(mentions(onlyProblem(collision("<box size='1 0 1'/>")), "link 'base', collision"));
  EXPECT_TRUE(mentions(onlyProblem(collision("<sphere radius='-1'/>")), "link 'base', collision"));
  EXPECT_TRUE(
      mentions(onlyProblem(collision("<cylinder radius='1' length='0'/>")), "link 'base', collision"));
}

TEST_F(RobotScene, TwoShapesInOneGeometryAreAProblemAndNotHalfABody) {
  EXPECT_TRUE(mentions(onlyProblem(collision("<sphere radius='1'/><box size='1 1 1'/>")), "holds 2 shapes"));
}

TEST_F(RobotScene, FaultsElsewhereInALinkDoNotCostItsGeometry) {
  for (const std::string fault :
       {"<visual><geometry><cone/></geometry></visual>", "<inertial><mass value='m'/></inertial>"}) {
    expectBox(onlySurface(fault + collision("<box size='2 2 2'/>")), {-1, -1, -1}, {1, 1, 1});
    EXPECT_TRUE(hasNote(last_scene, "geometry is read all the same"));
  }
}

TEST_F(RobotScene, MeshFilesThatAreMissingCorruptOrEmptyAreProblemsWithTheirPairsNamed) {
  folder.write("good.stl", test::tetrahedronStl());
  folder.write("corrupt.stl", "This is not a valid STL file.");
  folder.write("empty.stl", "");
  folder.write("flat.stl",
               "solid f\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\n"
               "endfacet\nendsolid f\n");
  std::string content = boxLink("fine");
  for (const char* name : {"good", "corrupt", "empty", "flat", "missing"}) {
    content += "<link name='" + std::string(name) + "'>" +
               collision("<mesh filename='package://arm_description/" + std::string(name) + ".stl'/>") +
               "</link>" + "<link name='" + name + "_carrier'/>" +
               joint("floating", "fine", std::string(name) + "_carrier") +
               joint("floating", std::string(name) + "_carrier", name);
  }
  const Scene scene = loadRobot(robot(content));
  EXPECT_EQ(bodyNames(scene), Names({"fine", "good"}));
  EXPECT_EQ(pairNames(scene), Names({"fine/good"}));
  ASSERT_EQ(scene.problems.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const char* name = std::array<const char*, 4>{"corrupt", "empty", "flat", "missing"}[i];
    EXPECT_TRUE(mentions(scene.problems[i].message, "body '" + std::string(name) + "' is not served"));
    EXPECT_TRUE(mentions(scene.problems[i].message, "pairs not served: fine/" + std::string(name)))
        << scene.problems[i].message;
  }
  EXPECT_TRUE(mentions(scene.problems[3].message, folder.path("missing.stl") + "' does not exist"));
}

TEST_F(RobotScene, UnknownPackageIsAProblem) {
  EXPECT_TRUE(mentions(onlyProblem(collision("<mesh filename='package://missing_package/foo.stl'/>")),
                       "package 'missing_package' is not known"));
}

TEST_F(RobotScene, RelativeMeshInAParameterIsAProblem) {
  EXPECT_TRUE(mentions(onlyProblem(collision("<mesh filename='foo.stl'/>")), "comes from no file"));
}

TEST(RobotSceneAlone, ReadsTheSrdfBesideTheRobotDescription) {
  SceneLoadOptions options;
  options.metric_memory_limit = 0;
  const std::string urdf = robot(boxLink("a") + bareLink("x") + boxLink("b") + joint("continuous", "a", "x") +
                                 joint("continuous", "x", "b"));
  EXPECT_EQ(allPairs(loadRobotScene(urdf, "robot_description", options)).size(), 1U);
  options.descriptions["robot_description_semantic"] =
      "<robot name='arm'><disable_collisions link1='a' link2='b'/></robot>";
  EXPECT_EQ(allPairs(loadRobotScene(urdf, "robot_description", options)).size(), 0U);
}

}  // namespace
}  // namespace concave_distance::robot_scene_test
