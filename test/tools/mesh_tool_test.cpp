#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/hostile_mesh_files.h"
#include "support/mesh_measures.h"
#include "support/temporary_folder.h"

namespace concave_distance::mesh_tool_test {
namespace {

/// The program as a user runs it.
struct Outcome {
  int status;
  std::string out;
  std::string errors;
};

class MeshTool : public testing::Test {
 protected:
  Outcome run(const std::string& arguments) const {
    const std::string command = std::string(CONCAVE_DISTANCE_MESH_TOOL) + " " + arguments + " > " +
                                folder.path("out") + " 2> " + folder.path("errors");
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), test::contentOf(folder.path("out")), test::contentOf(folder.path("errors"))};
  }

  std::string path(const std::string& name) const { return folder.path(name); }

  SurfaceMesh read(const std::string& name) const { return weldEqualVertices(importMesh(path(name)), name); }

  test::TemporaryFolder folder;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(MeshTool, InspectPrintsWhatTheMeshIs) {
  exportMesh(makeBox({1, 2, 3}), path("box.stl"));
  const Outcome outcome = run("inspect " + path("box.stl"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.errors, "");
  EXPECT_TRUE(contains(outcome.out, "in the file: 36 vertices, 12 triangles\n"));
  EXPECT_TRUE(contains(outcome.out, "repaired: 8 vertices, 12 triangles\n"));
  EXPECT_TRUE(contains(outcome.out, "shells: 1, closed: 1\n"));
  EXPECT_TRUE(contains(outcome.out, "size (m): 1 2 3\n"));
  EXPECT_TRUE(contains(outcome.out, "area (m^2): 22\n"));
  EXPECT_TRUE(contains(outcome.out, "volume (m^3): 6\n"));
}

TEST_F(MeshTool, EndsWithAnErrorWhenADeviceIsFull) {
  exportMesh(makeBox({1, 2, 3}), path("box.stl"));
  const std::string tool = CONCAVE_DISTANCE_MESH_TOOL;
  const auto status = [&](const std::string& arguments) {
    return WEXITSTATUS(std::system((tool + " " + arguments + " 2> " + path("errors")).c_str()));
  };
  EXPECT_EQ(status("inspect " + path("box.stl") + " > /dev/full"), 1);
  EXPECT_TRUE(contains(test::contentOf(path("errors")), "standard output: not everything could be written"));
  EXPECT_EQ(status("--help > /dev/full"), 1);
  std::filesystem::create_symlink("/dev/full", path("full.obj"));
  EXPECT_EQ(status("repair " + path("box.stl") + " " + path("full.obj")), 1);
  EXPECT_TRUE(contains(test::contentOf(path("errors")), "full.obj"));
}

TEST_F(MeshTool, RefusesToWriteOverItsInput) {
  exportMesh(makeBox({1, 2, 3}), path("box.stl"));
  const std::string before = test::contentOf(path("box.stl"));
  const Outcome outcome = run("repair " + path("box.stl") + " " + path("box.stl"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.errors, "the same file as the input")) << outcome.errors;
  EXPECT_EQ(test::contentOf(path("box.stl")), before);
}

TEST_F(MeshTool, RepairTurnsAndDropsAndSaysSo) {
  folder.write("bad.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 2\nf 1 4 3\nf 2 3 4\nf 2 3 4\nf 1 1 2\n");
  const Outcome outcome = run("repair " + path("bad.obj") + " " + path("good.ply"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_TRUE(
      contains(outcome.out, "1 zero-area triangle dropped, 1 duplicate triangle dropped, 1 triangle turned"));
  EXPECT_TRUE(test::isClosedManifold(read("good.ply")));
  EXPECT_NEAR(test::signedVolume(read("good.ply")), 1.0 / 6.0, 1e-7);
}

TEST_F(MeshTool, RepairKeepsTheWindingWhenAskedTo) {
  folder.write("inside_out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  ASSERT_EQ(run("repair --keep-winding " + path("inside_out.obj") + " " + path("same.obj")).status, 0);
  EXPECT_LT(test::signedVolume(read("same.obj")), 0.0);
}

TEST_F(MeshTool, RefineReachesTheEdgeLength) {
  exportMesh(makeBox({1, 1, 1}), path("box.stl"));
  const Outcome outcome = run("refine " + path("box.stl") + " " + path("fine.ply") + " --max-edge 0.2");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  const SurfaceMesh fine = read("fine.ply");
  EXPECT_LE(test::longestEdge(fine), 0.2 * (1.0 + 1e-6));
  EXPECT_NEAR(test::totalArea(fine), 6.0, 1e-6);
  EXPECT_TRUE(contains(outcome.out, std::to_string(fine.vertexCount()) + " vertices"));
}

TEST_F(MeshTool, SimplifyTakesBackWhatRefineAdded) {
  exportMesh(makeBox({1, 1, 1}), path("box.stl"));
  ASSERT_EQ(run("refine " + path("box.stl") + " " + path("fine.ply") + " --max-edge 0.2").status, 0);
  const Outcome outcome = run("simplify " + path("fine.ply") + " " + path("coarse.obj"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_TRUE(contains(outcome.out, "flat patches: 6\nwritten: 8 vertices, 12 triangles\n")) << outcome.out;
  const SurfaceMesh coarse = read("coarse.obj");
  EXPECT_EQ(coarse.triangleCount(), 12U);
  EXPECT_TRUE(test::isClosedManifold(coarse));
  EXPECT_NEAR(test::signedVolume(coarse), 1.0, 1e-12);
}

TEST_F(MeshTool, SimplifyServesEveryUnusualMesh) {
  for (const test::HostileMesh& mesh : test::writeHostileMeshes(path("hostile"))) {
    if (mesh.expectation != "served") continue;
    ASSERT_EQ(run("repair " + mesh.path + " " + path("repaired.ply")).status, 0) << mesh.name;
    const Outcome outcome = run("simplify " + mesh.path + " " + path("simple.ply"));
    EXPECT_EQ(outcome.status, 0) << mesh.name << ": " << outcome.errors;
    EXPECT_LE(read("simple.ply").triangleCount(), read("repaired.ply").triangleCount()) << mesh.name;
  }
}

TEST_F(MeshTool, ConvertScalesAndMirrors) {
  exportMesh(makeBox({1000, 2000, 3000}), path("millimetres.obj"));
  ASSERT_EQ(run("convert --scale 0.001 " + path("millimetres.obj") + " " + path("metres.stl")).status, 0);
  EXPECT_NEAR(test::signedVolume(read("metres.stl")), 6.0, 1e-5);
  ASSERT_EQ(run("convert " + path("metres.stl") + " " + path("mirrored.ply") + " --scale -1,1,2").status, 0);
  EXPECT_NEAR(test::signedVolume(read("mirrored.ply")), 12.0, 1e-5);
}

TEST_F(MeshTool, ErrorsNameTheFileAndTheRemedyAndEndWithStatusOne) {
  const std::string missing = path("missing.stl");
  Outcome outcome = run("inspect " + missing);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.errors,
            "mesh_tool: " + missing + ": there is no such file (check the path and the package it is in)\n");

  exportMesh(makeBox({1, 1, 1}), path("box.stl"));
  outcome = run("convert " + path("box.stl") + " " + path("box.xyz"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.errors, path("box.xyz")));
  EXPECT_EQ(run("refine " + path("box.stl") + " " + path("fine.stl") + " --max-edge 0").status, 1);
  EXPECT_EQ(run("convert --scale 0 " + path("box.stl") + " " + path("flat.stl")).status, 1);
}

TEST_F(MeshTool, AWrongCommandLineEndsWithStatusTwo) {
  exportMesh(makeBox({1, 1, 1}), path("box.stl"));
  for (const std::string& arguments :
       {std::string(), std::string("polish a.stl"), "refine " + path("box.stl") + " " + path("fine.stl"),
        "convert " + path("box.stl"), "inspect --scale 1,2 " + path("box.stl"),
        "inspect --scale big " + path("box.stl"),
        "simplify --tolerance -1 " + path("box.stl") + " " + path("simple.stl")}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.errors, "") << arguments;
  }
}

TEST_F(MeshTool, HelpGoesToStandardOutput) {
  for (const std::string arguments :
       {"--help", "inspect --help", "repair --help", "refine --help", "simplify --help", "convert --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(contains(outcome.out, "Usage: mesh_tool"));
  }
}

}  // namespace
}  // namespace concave_distance::mesh_tool_test
