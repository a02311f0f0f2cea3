#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <limits>
#include <map>

#include "base/constants.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/search/prepare_search.h"
#include "mesh/import/import_process.h"
#include "mesh/surface/mesh_topology.h"
#include "scene/body_pool.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"
#include "support/concave_shapes.h"
#include "support/scene_fixture.h"

namespace concave_distance::scene_loading_test {
namespace {

using test::bodyNames;
using test::hasNote;
using test::mentions;

class SceneLoading : public test::SceneTest {
 protected:
  static BodyDescription box(const std::string& name) {
    BodyDescription description;
    description.name = name;
    description.frame = "world";
    description.primitive = "box";
    description.dimensions = {1.0, 2.0, 3.0};
    description.max_edge_length = 0.5;
    return description;
  }
  std::string bodyRefusal(const BodyDescription& description) const {
    try {
      static_cast<void>(loadBody(description, folder.path(), options.package_locator));
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }
};

// Everything of a scene that loading could leave to chance.
std::string fingerprint(const Scene& scene) {
  std::string text;
  for (const SceneBody& body : scene.bodies) {
    text += body.name + " " + body.source + " " + std::to_string(gridOf(*body.mesh).graph().nodeCount()) +
            " " + (gridOf(*body.mesh).metric().isThinned() ? "thinned" : "whole") + " " +
            body.repair.summary() + "\n";
    for (const Eigen::Vector3d& p : gridOf(*body.mesh).nodes().grid.vertices()) {
      text.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
    }
    for (const TriangleNodes& t : gridOf(*body.mesh).nodes().grid.triangles()) {
      text.append(reinterpret_cast<const char*>(t.data()), sizeof(TriangleNodes));
    }
  }
  for (const ScenePair& pair : allPairs(scene)) {
    text += pair.name + " " + std::to_string(pair.body_a) + " " + std::to_string(pair.body_b) + "\n";
  }
  for (const SceneProblem& problem : scene.problems) text += problem.where + " " + problem.message + "\n";
  for (const std::string& note : scene.notes) text += note + "\n";
  return text;
}

std::string missingBody(int i) {
  const std::string number = std::to_string(i);
  return "  - {name: b" + number + ", mesh: missing" + number + ".stl}\n";
}

std::string ball(int i) {
  const std::string number = std::to_string(i);
  return "  - {name: b" + number + ", sphere: {radius: 0." + std::to_string(i + 1) +
         "}, max_edge_length: 0.1}\n";
}

TEST_F(SceneLoading, IsTheSameWhateverTheNumberOfThreads) {
  std::string yaml = "metric_memory_limit_mb: 1\nbodies:\n";
  for (int i = 0; i < 12; ++i) yaml += i % 4 == 3 ? missingBody(i) : ball(i);
  std::string alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = fingerprint(load(yaml));
  }
  for (int i = 0; i < 5; ++i) {
    const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
    EXPECT_EQ(fingerprint(load(yaml)), alone);
  }
  EXPECT_TRUE(mentions(alone, "thinned"));
  EXPECT_TRUE(mentions(alone, "whole"));
}

void prepareAll(const Scene& scene) {
  std::vector<const BodyMesh*> bodies;
  for (const SceneBody& body : scene.bodies) bodies.push_back(body.mesh.get());
  prepareSearch(bodies);
}

TEST_F(SceneLoading, MatricesGoToBodiesInOrderWhileTheLimitLasts) {
  // Grids of boxes as good as equal, so that the limit can be set to hold exactly two.
  const std::size_t nodes = gridOf(*loadBody(box("x"), "", nullptr).mesh).graph().nodeCount();
  options.metric_memory_limit = 2 * nodes * nodes * 6;
  std::string yaml = "bodies:\n";
  for (const std::string name : {"a", "b", "c"}) {
    yaml += "  - {name: " + name + ", box: {size: [1, 2, 2.99999" + std::to_string(name[0] - 'a') +
            "]}, max_edge_length: 0.5}\n";
  }
  const auto is_whole = [&](std::size_t body) {
    const Scene scene = load(yaml);
    EXPECT_EQ(scene.bodies.size(), 3U);
    prepareAll(scene);
    return !gridOf(*scene.bodies[body].mesh).metric().isThinned();
  };
  EXPECT_TRUE(is_whole(0));
  EXPECT_TRUE(is_whole(1));
  EXPECT_FALSE(is_whole(2));
  --options.metric_memory_limit;
  EXPECT_FALSE(is_whole(1));
}

TEST_F(SceneLoading, BodiesAddedLaterShareTheLimitOfMatrices) {
  const std::size_t nodes = gridOf(*loadBody(box("x"), "", nullptr).mesh).graph().nodeCount();
  options.metric_memory_limit = nodes * nodes * 6;
  const Scene scene = load("bodies: [{name: a, box: {size: [1, 2, 2.999999]}, max_edge_length: 0.5}]\n");
  EXPECT_FALSE(gridOf(*scene.bodies[0].mesh).metric().isThinned());
  const SceneBody added = loadBody(box("b"), "", nullptr, scene.pool);
  EXPECT_TRUE(gridOf(*added.mesh).metric().isThinned());
  EXPECT_EQ(scene.pool->metricMemory()->used(), options.metric_memory_limit);
}

TEST_F(SceneLoading, MatricesOfABodyThatIsGoneMakeRoomForOthers) {
  const auto pool = std::make_shared<BodyPool>(1'000'000'000);
  SceneBody body = loadBody(box("a"), "", nullptr, pool);
  gridOf(*body.mesh).metric();
  EXPECT_GT(pool->metricMemory()->used(), 0U);
  body = SceneBody();
  EXPECT_EQ(pool->metricMemory()->used(), 0U);
}

TEST_F(SceneLoading, BodiesOfTheSameSurfaceAndGridShareOneMesh) {
  const Scene scene = load(
      "bodies:\n"
      "  - {name: a, box: {size: [1, 2, 3]}}\n  - {name: b, box: {size: [1, 2, 3]}, frame: tool}\n"
      "  - {name: c, box: {size: [1, 2, 3]}, max_edge_length: 0.5}\n  - {name: d, box: {size: [1, 2, 4]}}\n");
  ASSERT_EQ(scene.bodies.size(), 4U);
  EXPECT_EQ(scene.bodies[0].mesh, scene.bodies[1].mesh);
  EXPECT_NE(scene.bodies[0].mesh, scene.bodies[2].mesh);
  EXPECT_NE(scene.bodies[0].mesh, scene.bodies[3].mesh);
  EXPECT_EQ(loadBody(box("e"), "", nullptr, scene.pool).mesh, scene.bodies[2].mesh);
}

TEST_F(SceneLoading, AMeshThatABodyHasIsNotReadAgainUntilItsFileChanges) {
  folder.write("t.stl", test::tetrahedronStl());
  BodyDescription description;
  description.name = "t";
  description.mesh_resource = "package://arm_description/t.stl";
  const auto pool = std::make_shared<BodyPool>(0);
  const auto load_now = [&] { return loadBody(description, "", options.package_locator, pool); };
  SceneBody first = load_now();
  ::setenv("CONCAVE_DISTANCE_IMPORT_WORKER", "/nowhere/worker", 1);  // that reads files
  const SceneBody second = load_now();
  EXPECT_EQ(second.mesh, first.mesh);
  EXPECT_EQ(second.repair.vertices_in, first.repair.vertices_in);
  description.scale = Eigen::Vector3d(1, 1, 2);
  EXPECT_THROW(load_now(), Error) << "not the same";
  description.scale = Eigen::Vector3d::Ones();
  description.max_edge_length = 0.125;
  EXPECT_THROW(load_now(), Error) << "another grid";
  description.max_edge_length.reset();
  folder.write("t.stl", test::tetrahedronStl() + test::tetrahedronStl());
  EXPECT_THROW(load_now(), Error) << "the file is another one now";
  ::unsetenv("CONCAVE_DISTANCE_IMPORT_WORKER");
  EXPECT_NE(load_now().repair.triangles_in, first.repair.triangles_in);
}

TEST_F(SceneLoading, AChangedFileIsReadAnew) {
  const std::string scene = "bodies: [{name: comb, mesh: comb.stl, max_edge_length: 100}]\n";
  exportMesh(test::makeComb(4), folder.path("comb.stl"));
  const Scene before = load(scene);
  options.pool = before.pool;
  EXPECT_EQ(load(scene).bodies[0].mesh, before.bodies[0].mesh);
  exportMesh(test::makeComb(7), folder.path("comb.stl"));
  EXPECT_NE(load(scene).bodies[0].mesh->diameter(), before.bodies[0].mesh->diameter());
}

TEST_F(SceneLoading, EveryInputThatChangesMakesAnotherMesh) {
  exportMesh(test::makeComb(4), folder.path("comb.stl"));
  exportMesh(makeSphere(0.4, 0.02), folder.path("ball.ply"));
  const std::vector<std::string> bodies = {"mesh: comb.stl",
                                           "mesh: comb.stl, max_edge_length: 0.1",
                                           "mesh: comb.stl, max_edge_length: 0.1000001",
                                           "mesh: comb.stl, scale: 2",
                                           "mesh: comb.stl, scale: [1, 1, -1]",
                                           "mesh: comb.stl, pose: {xyz: [0, 0, 1e-9]}",
                                           "mesh: ball.ply",
                                           "box: {size: [1, 1, 1]}",
                                           "box: {size: [1, 1, 1.0000001]}",
                                           "sphere: {radius: 1}",
                                           "sphere: {radius: 1}, chord_error: 0.02",
                                           "cylinder: {radius: 1, length: 2}",
                                           "capsule: {radius: 1, length: 2}"};
  std::string yaml = "bodies:\n";
  for (std::size_t i = 0; i < bodies.size(); ++i)
    yaml += "  - {name: b" + std::to_string(i) + ", " + bodies[i] + "}\n";
  const Scene scene = load(yaml);
  ASSERT_EQ(scene.bodies.size(), bodies.size());
  std::map<const BodyMesh*, std::string> body_of_mesh;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto [other, is_new] = body_of_mesh.emplace(scene.bodies[i].mesh.get(), bodies[i]);
    EXPECT_TRUE(is_new) << bodies[i] << " and " << other->second;
  }
}

TEST_F(SceneLoading, AFileThatIsReplacedWhileItIsReadIsNotKeptUnderItsOldContent) {
  // The first import puts another file in the place of the second mesh; the second one may put it back.
  exportMesh(test::makeComb(4), folder.path("comb.stl"));
  exportMesh(makeSphere(0.4, 0.02), folder.path("ball.ply"));
  const std::string worker = detail::importWorkerPath();
  const std::string robot =
      "<robot name='r'><link name='l'><collision><geometry><mesh "
      "filename='package://arm_description/comb.stl'/></geometry></collision>"
      "<collision><geometry><mesh "
      "filename='package://arm_description/ball.ply'/></geometry></collision></link></robot>";
  const auto diameter_of = [](const Scene& scene) { return scene.bodies.at(0).mesh->diameter(); };
  const double expected = diameter_of(loadRobot(robot));
  for (const bool put_back : {false, true}) {
    options.pool = std::make_shared<BodyPool>(0);
    exportMesh(makeSphere(4.0, 0.1), folder.path("other.ply"));
    const std::string replacing = folder.write(
        "worker", "#!/bin/sh\nPATH=/usr/bin:/bin\ncd '" + folder.path() +
                      "'\nif [ -e other.ply ]; then mv ball.ply kept.ply; mv other.ply ball.ply\n" +
                      (put_back ? "else mv kept.ply ball.ply\n" : "") + "fi\nexec '" + worker + "' \"$@\"\n");
    std::filesystem::permissions(replacing, std::filesystem::perms::owner_all);
    ::setenv("CONCAVE_DISTANCE_IMPORT_WORKER", replacing.c_str(), 1);
    const Scene replaced = loadRobot(robot);  // the pool has what it was made of as long as it lives
    ::unsetenv("CONCAVE_DISTANCE_IMPORT_WORKER");
    EXPECT_GT(diameter_of(replaced), expected + 1.0);
    EXPECT_EQ(std::filesystem::exists(folder.path("kept.ply")), !put_back);
    if (!put_back) std::filesystem::rename(folder.path("kept.ply"), folder.path("ball.ply"));
    EXPECT_EQ(diameter_of(loadRobot(robot)), expected) << "put back: " << put_back;
  }
}

TEST_F(SceneLoading, NothingOfTheSearchIsMadeBeforeItIsNeeded) {
  BodyDescription plain = box("crate");
  plain.max_edge_length.reset();
  const SceneBody body = loadBody(plain, "", nullptr);
  EXPECT_EQ(gridOf(*body.mesh).nodesIfMade(), nullptr);
  gridOf(*body.mesh).metric();
  EXPECT_NE(gridOf(*body.mesh).nodesIfMade(), nullptr);
}

TEST_F(SceneLoading, ABodyThatReachesTooFarIsRefusedAtOnce) {
  const auto problem = [&](const std::string& body) {
    return load("bodies: [{name: a, " + body + "}]\n").problems.at(0).message;
  };
  EXPECT_TRUE(
      mentions(problem("box: {size: [1, 1, 1]}, pose: {xyz: [0, 1.0e+17, 0]}"), "the limit is 1e9 m"));
  EXPECT_TRUE(mentions(problem("box: {size: [1, 1, 1.0e+15]}"), "it reaches 5e+14 m"));
  EXPECT_NE(problem("sphere: {radius: 1.0e+300}"), "");
}

TEST_F(SceneLoading, WhatIsBeyondALimitIsRefusedWithTheFigure) {
  options.limits.nodes = 1000;
  options.limits.triangles = 11;
  const std::string bodies =
      "bodies: [{name: a, box: {size: [1, 1, 1]}}, {name: b, box: {size: [1, 1, 2]}}]\n";
  EXPECT_TRUE(mentions(load(bodies).problems.at(0).message, "12 triangles"));
  options.limits.triangles = 12;
  const Scene fine = load("bodies: [{name: a, box: {size: [1, 1, 1]}, max_edge_length: 0.002}]\n");
  EXPECT_TRUE(fine.bodies.empty());
  EXPECT_TRUE(mentions(fine.problems.at(0).message, "search grid of about 2.2"));
  EXPECT_TRUE(mentions(fine.problems.at(0).message, "the limit is 1000 nodes"));
  options.limits.pairs = 0;  // of named pairs, and of those near at one time
  EXPECT_EQ(allPairs(load(bodies)).size(), 1U);
  EXPECT_THROW(load(bodies + "pairs: [{between: [a, b]}]\n"), Error);
  options.limits.pairs = 1;
  EXPECT_EQ(load(bodies + "pairs: [{between: [a, b]}]\n").pairs.size(), 1U);
  options.limits.bodies = 1;
  EXPECT_THROW(load(bodies), Error);
}

TEST_F(SceneLoading, AnAutomaticGridIsThinnedAsBodyMeshDoesAndCountedSo) {
  BodyDescription ball = box("ball");
  ball.primitive = "sphere";
  ball.dimensions = {1.0};
  ball.chord_error = 1e-3;
  ball.max_edge_length.reset();
  const std::size_t kLimit = BodyMeshOptions().search_node_limit;
  const SceneBody thinned = loadBody(ball, "", nullptr, std::make_shared<BodyPool>(kLimit * kLimit * 6));
  EXPECT_GT(gridOf(*thinned.mesh).nodes().grid.vertexCount(), kLimit);
  EXPECT_EQ(gridOf(*thinned.mesh).graph().nodeCount(), kLimit);
  EXPECT_FALSE(gridOf(*thinned.mesh).metric().isThinned());
  const auto too_small = std::make_shared<BodyPool>(kLimit * kLimit * 6 - 1);
  EXPECT_TRUE(gridOf(*loadBody(ball, "", nullptr, too_small).mesh).metric().isThinned());
}

TEST_F(SceneLoading, LimitOfTheFileGoesBeforeTheCallers) {
  const std::string bodies = "bodies: [{name: a, box: {size: [1, 1, 1]}, max_edge_length: 0.2}]\n";
  EXPECT_FALSE(gridOf(*load(bodies).bodies[0].mesh).metric().isThinned());
  EXPECT_TRUE(gridOf(*load("metric_memory_limit_mb: 0\n" + bodies).bodies[0].mesh).metric().isThinned());
  options.metric_memory_limit = 0;
  EXPECT_TRUE(gridOf(*load(bodies).bodies[0].mesh).metric().isThinned());
  EXPECT_FALSE(gridOf(*load("metric_memory_limit_mb: 1\n" + bodies).bodies[0].mesh).metric().isThinned());
}

TEST_F(SceneLoading, BrokenFilesAreProblemsAndTheRestIsServed) {
  folder.write("good.stl", test::tetrahedronStl());
  folder.write("corrupt.obj", "v 0 0 zero\nf 1 2 3\n");
  folder.write("truncated.stl", std::string(80, ' ') + std::string("\xff\xff\xff\x00", 4) + "abc");
  folder.write("unknown.xyz", "what is this");
  const Scene scene = load(
      "defaults: {max_edge_length: 100}\n"
      "bodies:\n"
      "  - {name: corrupt, mesh: corrupt.obj}\n  - {name: truncated, mesh: truncated.stl}\n"
      "  - {name: unknown, mesh: unknown.xyz}\n  - {name: folder, mesh: .}\n  - {name: good, mesh: "
      "good.stl}\n"
      "  - {name: box, box: {size: [1, 1, 1]}}\n");
  EXPECT_EQ(bodyNames(scene), (std::vector<std::string>{"good", "box"}));
  EXPECT_EQ(test::pairNames(scene), std::vector<std::string>{"good/box"});
  ASSERT_EQ(scene.problems.size(), 4U);
  EXPECT_EQ(scene.problems[1].where, "scene.yaml:4, bodies[1], body 'truncated'");
  EXPECT_TRUE(mentions(scene.problems[1].message, "truncated.stl"));
}

TEST_F(SceneLoading, AGridTooFineForAnyMachineIsAProblem) {
  const Scene scene = load(
      "bodies:\n"
      "  - {name: fine, box: {size: [1, 1, 1]}, max_edge_length: 1.0e-6}\n"
      "  - {name: box, box: {size: [1, 1, 1]}, max_edge_length: 1}\n");
  EXPECT_EQ(bodyNames(scene), std::vector<std::string>{"box"});
  ASSERT_EQ(scene.problems.size(), 1U);
}

/// The scenes and robots that this package brings along; matrices are left out, for time.
SceneLoadOptions packageOptions() {
  SceneLoadOptions options;
  options.metric_memory_limit = 0;
  options.package_locator = [](const std::string& package) {
    return package == "concave_distance" ? std::string(CONCAVE_DISTANCE_SOURCE_DIR) : std::string();
  };
  return options;
}

TEST(SceneOfThePackage, RobotsLoadWithoutProblemsAndWatchAllButNeighbours) {
  SceneLoadOptions options = packageOptions();
  for (const std::string robot : {"wam", "kr5"}) {
    const std::string file = CONCAVE_DISTANCE_SOURCE_DIR "/urdf/" + robot + ".urdf";
    const Scene scene = loadRobotScene(test::contentOf(file), file, options);
    EXPECT_TRUE(scene.problems.empty()) << scene.problems.front().message;
    // A row of n links has n (n - 1) / 2 pairs, n - 1 of them neighbours.
    const std::size_t n = robot == "wam" ? 8 : 7;
    EXPECT_EQ(scene.bodies.size(), n);
    EXPECT_EQ(allPairs(scene).size(), n * (n - 1) / 2 - (n - 1));
  }
}

TEST(SceneOfThePackage, ConfiguredScenesLoadWithoutProblems) {
  SceneLoadOptions options = packageOptions();
  options.descriptions["robot_description"] = test::contentOf(CONCAVE_DISTANCE_SOURCE_DIR "/urdf/wam.urdf");
  for (const std::string name : {"contact", "insertion", "interactive", "robot"}) {
    const Scene scene = loadSceneFile(CONCAVE_DISTANCE_SOURCE_DIR "/config/" + name + ".yaml", options);
    EXPECT_TRUE(scene.problems.empty()) << scene.problems.front().message;
    EXPECT_FALSE(allPairs(scene).empty()) << name;
  }
}

TEST_F(SceneLoading, SingleBodyIsLoadedAsASceneDoes) {
  const SceneBody body = loadBody(box("crate"), "", nullptr);
  EXPECT_EQ(body.name, "crate");
  EXPECT_EQ(body.frame, "world");
  EXPECT_EQ(body.mesh->name(), "crate");
  EXPECT_NEAR(test::signedVolume(body.mesh->surface()), 6.0, 1e-12);
  EXPECT_FALSE(gridOf(*body.mesh).metric().isThinned());
  EXPECT_FALSE(body.in_robot_model);
  EXPECT_TRUE(gridOf(*loadBody(box("crate"), "", nullptr, std::make_shared<BodyPool>(100)).mesh)
                  .metric()
                  .isThinned());
}

TEST_F(SceneLoading, SingleBodyWithAMeshIsPlacedInItsFrame) {
  folder.write("t.stl", test::tetrahedronStl());
  BodyDescription description;
  description.name = "t";
  description.mesh_resource = "package://arm_description/t.stl";
  description.scale = Eigen::Vector3d(1, -1, 1);
  description.frame_from_geometry.translation() = Eigen::Vector3d(5, 0, 0);
  description.max_edge_length = 9.0;
  const SceneBody body = loadBody(description, "", options.package_locator);
  EXPECT_TRUE(body.mesh->surface().boundingBox().min().isApprox(Eigen::Vector3d(5, -2, 0)));
  EXPECT_NEAR(test::signedVolume(body.mesh->surface()), 1.0, 1e-9);
}

TriangleSoup tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST_F(SceneLoading, SingleBodyOfSeveralShapesHasAllOfThemAsShells) {
  BodyDescription description = box("tool");
  BodyShape cone;
  cone.primitive = "cone";
  cone.dimensions = {0.5, 2.0};
  cone.frame_from_geometry.translation().z() = 9.0;
  BodyShape given;
  given.triangles = std::make_shared<const TriangleSoup>(tetrahedron());
  given.frame_from_geometry.translation().x() = 5.0;
  description.other_shapes = {cone, given};
  const SceneBody body = loadBody(description, "", nullptr);
  EXPECT_EQ(body.mesh->topology().shell_is_closed, std::vector<bool>(3, true));
  const double cone_volume = 0.25 * kPi * 2.0 / 3.0;
  EXPECT_NEAR(test::signedVolume(body.mesh->surface()), 6.0 + 1.0 / 6.0 + cone_volume, 0.02 * cone_volume);
  EXPECT_NEAR(body.mesh->surface().boundingBox().max().x(), 6.0, 1e-12);
  EXPECT_NEAR(body.mesh->surface().boundingBox().max().z(), 10.0, 1e-12);
}

TEST_F(SceneLoading, BodiesOfGivenTrianglesAreRefusedOneByOne) {
  BodyDescription good = box("good");
  BodyDescription given;
  given.name = "given";
  given.frame = "world";
  const auto with = [&](const TriangleSoup& soup) {
    given.triangles = std::make_shared<const TriangleSoup>(soup);
    return given;
  };
  TriangleSoup no_corner = tetrahedron();
  no_corner.triangles[0][0] = 4;
  TriangleSoup no_number = tetrahedron();
  no_number.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  TriangleSoup many = tetrahedron();
  for (int doubling = 0; doubling < 4; ++doubling) {
    many.triangles.insert(many.triangles.end(), many.triangles.begin(), many.triangles.end());
  }
  SceneLimits limits;
  limits.triangles = 60;
  const std::vector<LoadedBody> loaded =
      loadBodies({good, with(tetrahedron()), with({}), with(no_corner), with(no_number), with(many)}, "",
                 nullptr, nullptr, limits);
  ASSERT_EQ(loaded.size(), 6U);
  EXPECT_TRUE(loaded[0].body && !loaded[0].problem);
  EXPECT_TRUE(loaded[1].body && !loaded[1].problem);
  const std::vector<std::string> parts = {"the mesh has no triangle", "vertex", "vertex", "64 triangles"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ASSERT_TRUE(loaded[i + 2].problem) << parts[i];
    EXPECT_TRUE(mentions(loaded[i + 2].problem->what(), "body 'given'"));
    EXPECT_TRUE(mentions(loaded[i + 2].problem->what(), parts[i])) << loaded[i + 2].problem->what();
  }
  given.primitive = "box";
  EXPECT_TRUE(mentions(bodyRefusal(with(tetrahedron())), "both a mesh and a primitive"));
}

TEST_F(SceneLoading, SingleBodyThatCannotBeLoadedIsRefusedByName) {
  BodyDescription description = box("crate");
  description.dimensions = {1.0, 2.0};
  EXPECT_TRUE(mentions(bodyRefusal(description), "body 'crate'"));
  EXPECT_TRUE(mentions(bodyRefusal(description), "a box with 2 dimensions"));
  description.dimensions = {1.0, 2.0, -3.0};
  EXPECT_TRUE(mentions(bodyRefusal(description), "body 'crate'"));
  description.primitive = "torus";
  EXPECT_TRUE(mentions(bodyRefusal(description), "primitive 'torus' is not known"));
  description.primitive = "";
  EXPECT_TRUE(mentions(bodyRefusal(description), "file name is empty"));
  description.mesh_resource = "package://gone/a.stl";
  EXPECT_TRUE(mentions(bodyRefusal(description), "package 'gone' is not known"));
  description.primitive = "box";
  EXPECT_TRUE(mentions(bodyRefusal(description), "both a mesh and a primitive"));
  description = box("crate");
  description.max_edge_length = -1.0;
  EXPECT_TRUE(mentions(bodyRefusal(description), "body 'crate'"));
  description = box("crate");
  description.frame_from_geometry.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(mentions(bodyRefusal(description), "the pose is not finite"));
  description = box("crate");
  description.primitive = "sphere";
  description.dimensions = {1.0};
  description.chord_error = 0.0;
  EXPECT_TRUE(mentions(bodyRefusal(description), "body 'crate'"));
}

TEST_F(SceneLoading, StrictlyAProblemIsAnError) {
  const std::string urdf =
      "<robot name='r'><link name='base'><collision><geometry><mesh filename='package://unknown/a.stl'/>"
      "</geometry></collision></link></robot>";
  EXPECT_EQ(loadRobotScene(urdf, "robot", options).problems.size(), 1U);
  options.strict = true;
  try {
    static_cast<void>(loadRobotScene(urdf, "robot", options));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_TRUE(mentions(error.what(), "package")) << error.what();
    EXPECT_TRUE(mentions(error.what(), "unknown")) << error.what();
  }
  EXPECT_THROW(static_cast<void>(loadSceneText("bodies: [{name: a, mesh: missing.stl}]", "scene.yaml",
                                               folder.path(), options)),
               Error);
}

}  // namespace
}  // namespace concave_distance::scene_loading_test
