#include "concave_distance/mesh/import/import_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/mesh_measures.h"
#include "support/temporary_folder.h"

namespace concave_distance::import_mesh_test {
namespace {

using test::contentOf;
using test::TemporaryFolder;

std::string fixture(const std::string& name) {
  return std::string(CONCAVE_DISTANCE_TEST_DATA "/mesh/") + name;
}

/// What importMesh throws for `path`; fails the test when it throws nothing.
std::string errorOf(const std::string& path, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones()) {
  try {
    importMesh(path, scale);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), path);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  ADD_FAILURE() << path << " was accepted";
  return {};
}

const std::vector<Eigen::Vector3d>& tetrahedronCorners() {
  static const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  return corners;
}

/// Single precision: half a unit of rounding for each of a vertex, its unit, a rotation and a shift.
constexpr double kImportTolerance = 4.0 * 6e-8 * 3.0;

void expectTetrahedron(const TriangleSoup& soup, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones()) {
  const SurfaceMesh mesh = weldEqualVertices(soup, "imported");
  ASSERT_EQ(mesh.vertexCount(), 4U);
  ASSERT_EQ(mesh.triangleCount(), 4U);
  EXPECT_TRUE(test::isClosedManifold(mesh));
  EXPECT_NEAR(test::signedVolume(mesh), std::abs(scale.prod()),
              10.0 * kImportTolerance * std::abs(scale.prod()));
  for (const Eigen::Vector3d& corner : tetrahedronCorners()) {
    const Eigen::Vector3d wanted = scale.cwiseProduct(corner);
    const bool found = std::any_of(mesh.vertices().begin(), mesh.vertices().end(), [&](const auto& vertex) {
      return (vertex - wanted).norm() <= kImportTolerance * scale.cwiseAbs().maxCoeff();
    });
    EXPECT_TRUE(found) << "no vertex at " << wanted.transpose();
  }
}

const std::vector<std::string>& tetrahedronFiles() {
  static const std::vector<std::string> names{"tetrahedron.obj", "tetrahedron.ply", "tetrahedron_ascii.stl",
                                              "tetrahedron.dae"};
  return names;
}

TEST(ImportMesh, ReadsTheSameBodyFromEveryFormat) {
  for (const std::string& name : tetrahedronFiles()) {
    SCOPED_TRACE(name);
    expectTetrahedron(importMesh(fixture(name)));
  }
}

TEST(ImportMesh, ReadsBinaryStlAlsoWhenItsHeaderSaysSolid) {
  const TemporaryFolder folder;
  const std::string path = folder.path("body.STL");
  exportMesh(weldEqualVertices(importMesh(fixture("tetrahedron.obj")), "tetrahedron"), path);
  expectTetrahedron(importMesh(path));
  std::string bytes = contentOf(path);
  bytes.replace(0, 5, "solid");
  expectTetrahedron(importMesh(folder.write("solid.stl", bytes)));
}

TEST(ImportMesh, ScalesEachAxisAndKeepsMirroredBodiesOutward) {
  for (const std::string& name : tetrahedronFiles()) {
    for (const Eigen::Vector3d& scale :
         {Eigen::Vector3d(0.001, 0.001, 0.001), Eigen::Vector3d(2, 3, 4), Eigen::Vector3d(-1, 1, 1),
          Eigen::Vector3d(1, -2, 1), Eigen::Vector3d(1, -1, -1), Eigen::Vector3d(-1, -1, -0.5)}) {
      SCOPED_TRACE(name + " scaled by " + std::to_string(scale.x()) + " " + std::to_string(scale.y()) + " " +
                   std::to_string(scale.z()));
      expectTetrahedron(importMesh(fixture(name), scale), scale);
    }
  }
}

TEST(ImportMesh, AppliesTheUnitOfADaeFile) {
  const TemporaryFolder folder;
  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  const auto with_unit = [&](const std::string& unit) {
    return importMesh(
        folder.write("unit.dae", test::replaced(dae, R"(<unit name="millimeter" meter="0.001"/>)", unit)));
  };
  expectTetrahedron(with_unit(R"(<unit name="meter" meter="1"/>)"), Eigen::Vector3d::Constant(1e3));
  expectTetrahedron(with_unit(R"(<unit name="inch" meter="0.0254"/>)"), Eigen::Vector3d::Constant(25.4));
  expectTetrahedron(with_unit(""), Eigen::Vector3d::Constant(1e3));  // metres when nothing is said
}

TEST(ImportMesh, KeepsTheAxesOfADaeFileWhateverItsUpAxis) {
  // As rviz does: its mesh loader drops the turn that assimp puts on the root.
  const TemporaryFolder folder;
  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  for (const std::string up : {"<up_axis>X_UP</up_axis>", "<up_axis>Y_UP</up_axis>", ""}) {
    SCOPED_TRACE(up);
    expectTetrahedron(importMesh(folder.write("up.dae", test::replaced(dae, "<up_axis>Z_UP</up_axis>", up))));
  }
}

TEST(ImportMesh, TurnsTheWindingWhereANodeOfTheFileMirrors) {
  const TemporaryFolder folder;
  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  const std::string path =
      folder.write("mirror.dae", test::replaced(dae, "<scale>2 2 2</scale>", "<scale>2 2 -2</scale>"));
  expectTetrahedron(importMesh(path), {1, 1, -1});
  expectTetrahedron(importMesh(path, {1, 1, -1}));  // mirrored twice
}

TEST(ImportMesh, PassesOverFacesOfFewerThanThreeCorners) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(importMesh(folder.write("faces.ply", header + "3 0 1 2\n0\n1 2\n2 0 1\n")).triangles.size(), 1U);
  EXPECT_NE(errorOf(folder.write("none.ply", header + "0\n0\n1 2\n2 0 1\n")).find("no triangle"),
            std::string::npos);
}

TEST(ImportMesh, MergesEveryMeshOfAFile) {
  const TemporaryFolder folder;
  const std::string instance = R"(<instance_geometry url="#mesh"/>)";
  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  const std::string other_node =
      R"(<node id="second" type="NODE"><translate>9000 0 0</translate>)" + instance + "</node>";
  const std::string path =
      folder.write("two.dae", test::replaced(dae, "</visual_scene>", other_node + "</visual_scene>"));
  const SurfaceMesh mesh = weldEqualVertices(importMesh(path), "two");
  EXPECT_EQ(mesh.vertexCount(), 8U);
  EXPECT_EQ(mesh.triangleCount(), 8U);
  EXPECT_NEAR(mesh.boundingBox().max().x(), 9.75, 1e-5);  // 750 mm of the geometry, moved by 9 m

  const std::string solid = contentOf(fixture("tetrahedron_ascii.stl"));
  EXPECT_EQ(importMesh(folder.write("two.stl", solid + solid)).triangles.size(), 8U);
}

TEST(ImportMesh, CutsPolygonsIntoTriangles) {
  const TemporaryFolder folder;
  const std::string dart = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n";  // concave
  const SurfaceMesh mesh = weldEqualVertices(importMesh(folder.write("dart.obj", dart)), "dart");
  EXPECT_EQ(mesh.triangleCount(), 3U);
  EXPECT_NEAR(test::totalArea(mesh), 2.5, 1e-12);
  for (std::size_t t = 0; t < 3; ++t) EXPECT_GT(test::areaVector(mesh, t).z(), 0.0);
}

TEST(ImportMesh, RefusesFilesThatAreNotThereOrEmpty) {
  const TemporaryFolder folder;
  EXPECT_NE(errorOf(folder.path("missing.stl")).find("no such file"), std::string::npos);
  EXPECT_NE(errorOf(folder.path()).find("not a file"), std::string::npos);
  for (const std::string name : {"empty.stl", "empty.obj", "empty.ply", "empty.dae"}) {
    EXPECT_NE(errorOf(folder.write(name, "")).find("empty"), std::string::npos);
  }
  errorOf(folder.write("unknown.ending", "v 0 0 0"));
}

TEST(ImportMesh, RefusesFilesThatBreakOff) {
  const TemporaryFolder folder;
  const std::string ascii_stl = contentOf(fixture("tetrahedron_ascii.stl"));
  const std::string second_facet = ascii_stl.substr(0, ascii_stl.find("endfacet") + 9);
  errorOf(folder.write("between_facets.stl", second_facet));
  errorOf(folder.write("within_second_solid.stl", ascii_stl + second_facet));
  errorOf(folder.write("within.stl", ascii_stl.substr(0, ascii_stl.size() / 2)));

  const std::string binary_path = folder.path("whole.stl");
  exportMesh(makeBox({1, 1, 1}), binary_path);
  std::string binary = contentOf(binary_path);
  errorOf(folder.write("binary.stl", binary.substr(0, binary.size() - 20)));
  errorOf(folder.write("header.stl", binary.substr(0, 60)));
  errorOf(folder.write("longer.stl", binary + std::string(50, 'x')));  // as long as another facet
  binary.replace(0, 5, "solid");
  errorOf(folder.write("binary_solid.stl", binary.substr(0, binary.size() - 50)));

  const std::string ply = contentOf(fixture("tetrahedron.ply"));
  errorOf(folder.write("faces.ply", ply.substr(0, ply.size() - 9)));
  errorOf(folder.write("vertices.ply", ply.substr(0, ply.find("0 0 3"))));
  errorOf(folder.write("header.ply", ply.substr(0, ply.find("end_header"))));

  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  for (const std::size_t part : {dae.size() / 4, dae.size() / 2, dae.size() - 20}) {
    errorOf(folder.write("cut.dae", dae.substr(0, part)));
  }
}

TEST(ImportMesh, ReadsAndChecksBinaryPly) {
  const TemporaryFolder folder;
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto add_float = [&](double value) {
    const auto single = static_cast<float>(value);
    ply.append(reinterpret_cast<const char*>(&single), sizeof single);
  };
  for (const Eigen::Vector3d& corner : tetrahedronCorners()) {
    add_float(corner.x());
    add_float(corner.y());
    add_float(corner.z());
  }
  const std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const auto& face : faces) {
    ply.push_back('\3');
    ply.append(reinterpret_cast<const char*>(face.data()), sizeof face);
  }
  expectTetrahedron(importMesh(folder.write("binary.ply", ply)));
  errorOf(folder.write("cut.ply", ply.substr(0, ply.size() - 5)));
  errorOf(folder.write("no_faces.ply", ply.substr(0, ply.size() - 52)));
}

TEST(ImportMesh, RefusesCorruptFiles) {
  const TemporaryFolder folder;
  std::string noise;
  for (int i = 0; i < 2000; ++i) noise.push_back(static_cast<char>((i * 7919) % 251));
  for (const std::string name : {"noise.stl", "noise.obj", "noise.ply", "noise.dae"}) {
    errorOf(folder.write(name, noise));
  }
  errorOf(folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
  errorOf(folder.write("index.ply",
                       test::replaced(contentOf(fixture("tetrahedron.ply")), "3 0 1 3", "3 0 1 353983")));
  errorOf(folder.write("polygon.ply",
                       test::replaced(contentOf(fixture("tetrahedron.ply")), "3 0 1 3", "4 0 1 3 999")));
  const std::string dae = contentOf(fixture("tetrahedron.dae"));
  errorOf(folder.write("letter.dae", test::replaced(dae, "<p>0 2 1", "<p>0 2 x")));
  errorOf(folder.write("index.dae", test::replaced(dae, "<p>0 2 1", "<p>0 2 1000")));
  errorOf(folder.write("count.dae", test::replaced(dae, "count=\"12\"", "")));
  errorOf(folder.write("number.dae", test::replaced(dae, "-250 0 0", "-250 0 $")));
  errorOf(folder.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"));
  errorOf(folder.write("words.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><asset/></COLLADA>"));
}

TEST(ImportMesh, RefusesABodyWhoseShapeSinglePrecisionLoses) {
  const TemporaryFolder folder;
  const auto box_at = [&](double x) {
    TriangleSoup box;
    appendTransformed(box, {makeBox({1, 1, 1}).vertices(), {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}},
                      Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)));
    const std::string path = folder.path("far.stl");
    exportMesh(weldEqualVertices(box, "box"), path);
    return path;
  };
  EXPECT_EQ(importMesh(box_at(1e4)).triangles.size(), 3U);
  EXPECT_NE(errorOf(box_at(1e6)).find("seven digits"), std::string::npos);
  EXPECT_NE(errorOf(box_at(1e15)).find("seven digits"), std::string::npos);
  const std::string far_dae =
      folder.write("far.dae", test::replaced(contentOf(fixture("tetrahedron.dae")),
                                             "-250 0 0 -250 -500 0 750 0 0 -250 0 1500",
                                             "1e9 0 0 1e9 -500 0 1000001000 0 0 1e9 0 1500"));
  EXPECT_NE(errorOf(far_dae).find("seven digits"), std::string::npos);
}

TEST(ImportMesh, ReadsAllDigitsOfATextFarFromItsOrigin) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("far.obj", "v 1e15 0 0\nv 1000000000000001 0.1 0\nv 1e15 1 0\nf 1 2 3\n");
  const TriangleSoup soup = importMesh(path);
  EXPECT_EQ(soup.vertices[1], Eigen::Vector3d(1000000000000001.0, 0.1, 0.0));
}

TEST(ImportMesh, RefusesFilesWithoutFaces) {
  const TemporaryFolder folder;
  errorOf(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  errorOf(folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n"));
  errorOf(folder.write("points.ply",
                       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n1 0 0\n"));
  errorOf(folder.write("none.stl", "solid nothing\nendsolid nothing\n"));
  errorOf(folder.write("none.dae", test::replaced(contentOf(fixture("tetrahedron.dae")),
                                                  R"(<instance_geometry url="#mesh"/>)", "")));
}

TEST(ImportMesh, RefusesAScaleThatIsZeroOrNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, nan, infinity}) {
    EXPECT_NE(errorOf(fixture("tetrahedron.obj"), {1.0, bad, 1.0}).find("scale"), std::string::npos);
  }
}

TEST(ExportMesh, KeepsVerticesTrianglesAndWindingOnTheWayBack) {
  const TemporaryFolder folder;
  const SurfaceMesh ball = makeSphere(0.7, 0.01);
  for (const std::string ending : {".obj", ".ply", ".stl", ".STL"}) {
    SCOPED_TRACE(ending);
    const std::string path = folder.path("ball" + ending);
    exportMesh(ball, path);
    const SurfaceMesh back = weldEqualVertices(importMesh(path), path);
    ASSERT_EQ(back.triangleCount(), ball.triangleCount());
    EXPECT_EQ(back.vertexCount(), ball.vertexCount());
    for (std::size_t t = 0; t < ball.triangleCount(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const double error =
            (back.corner(TriangleIndex{t}, k) - ball.corner(TriangleIndex{t}, k)).cwiseAbs().maxCoeff();
        ASSERT_LE(error, 0.7 * 6e-8);  // half a unit of single precision
      }
    }
  }
}

TEST(ExportMesh, WritesSeventeenDigits) {
  const TemporaryFolder folder;
  const std::vector<Eigen::Vector3d> vertices{{1.0 / 3.0, 0, 0}, {1, 1e-30, 0}, {0, 1, -1e6 / 7.0}};
  const SurfaceMesh mesh(vertices, {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}}, "triangle");
  for (const std::string ending : {".obj", ".ply"}) {
    exportMesh(mesh, folder.path("digits" + ending));
    const std::string text = contentOf(folder.path("digits" + ending));
    EXPECT_NE(text.find("0.33333333333333331"), std::string::npos);
    EXPECT_NE(text.find("-142857.14285714287"), std::string::npos);
  }
}

TEST(ExportMesh, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  const SurfaceMesh box = makeBox({1, 1, 1});
  EXPECT_THROW(exportMesh(box, folder.path("box.dae")), Error);
  EXPECT_THROW(exportMesh(box, folder.path("box")), Error);
  EXPECT_THROW(exportMesh(box, folder.path("no/such/folder/box.stl")), Error);
  EXPECT_THROW(exportMesh(makeBox({1e39, 1, 1}), folder.path("huge.stl")), Error);
}

TEST(AppendTransformed, PlacesEachPartInTheBodysFrame) {
  TriangleSoup body = importMesh(fixture("tetrahedron.ply"));
  const TriangleSoup part = body;
  Eigen::Isometry3d body_from_part = Eigen::Isometry3d::Identity();
  body_from_part.translate(Eigen::Vector3d(5, 0, 0));
  body_from_part.rotate(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Eigen::Vector3d::UnitZ()));
  appendTransformed(body, part, body_from_part);
  ASSERT_EQ(body.vertices.size(), 8U);
  ASSERT_EQ(body.triangles.size(), 8U);
  EXPECT_LE((body.vertices[5] - Eigen::Vector3d(5, 1, 0)).norm(), 1e-12);  // (1, 0, 0) turned and moved
  for (std::size_t t = 0; t < 4; ++t) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(body.triangles[4 + t][k], part.triangles[t][k] + 4);
  }
  EXPECT_NEAR(test::signedVolume(weldEqualVertices(body, "two parts")), 2.0, 1e-6);
}

}  // namespace
}  // namespace concave_distance::import_mesh_test
