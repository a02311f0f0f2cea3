// Small files that were read wrong or refused, each with the right answer, and the kinds that they stand for.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <locale>
#include <string>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/import/import_worker/read_mesh.h"
#include "support/mesh_measures.h"
#include "support/temporary_folder.h"

namespace concave_distance::mesh_cases_test {
namespace {

std::string dataOf(const std::string& name) {
  return std::string(CONCAVE_DISTANCE_TEST_DATA "/mesh/") + name;
}

TriangleSoup read(const std::string& content, const std::string& extension) {
  return detail::readMesh(content, "file", extension, Eigen::Vector3d::Ones(), 1'000'000);
}

std::string refusalOf(const std::string& content, const std::string& extension) {
  try {
    read(content, extension);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "file");
    EXPECT_FALSE(error.remedy().empty());
    return error.whatIsWrong();
  }
  ADD_FAILURE() << "accepted: " << content.substr(0, 200);
  return {};
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string withLineEnds(const std::string& text, const std::string& end) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
  return changed;
}

void expectTetrahedron(const TriangleSoup& soup) {
  const SurfaceMesh mesh = weldEqualVertices(soup, "tetrahedron");
  EXPECT_EQ(mesh.vertexCount(), 4U);
  EXPECT_EQ(mesh.triangleCount(), 4U);
  EXPECT_TRUE(test::isClosedManifold(mesh));
  EXPECT_NEAR(test::signedVolume(mesh), 1.0, 1e-6);
}

TEST(MeshCases, EveryFileGivesItsRightAnswer) {
  struct Case {
    const char* name;
    std::size_t triangles;
    double area;
    double volume;
  };
  constexpr double kOpen = 0.0;  // a polygon in the plane z = 0
  for (const Case& wanted : {
           Case{"L_minimal.obj", 4, 3.0, kOpen},
           Case{"L_triangles.obj", 20, 14.0, 3.0},
           Case{"concave_L.obj", 20, 14.0, 3.0},
           Case{"concave_L.ply", 20, 14.0, 3.0},
           Case{"probe.obj", 12, 0.0024, 8e-6},
           Case{"tristrips.ply", 12, 6.0, 1.0},
           Case{"camera_vertex_face_ascii.ply", 12, 6.0, 1.0},
           Case{"camera_vertex_face_binary.ply", 12, 6.0, 1.0},
           Case{"binary_begins_with_0a.ply", 12, 6.0, 1.0},
           Case{"end_solid_two_words.stl", 12, 6.0, 1.0},
           Case{"long_tail_after_endsolid.stl", 12, 6.0, 1.0},
           Case{"bin_trailing_1.stl", 12, 6.0, 1.0},
           Case{"capitals.stl", 12, 6.0, 1.0},
           Case{"leading_blank.stl", 12, 6.0, 1.0},
           Case{"four_cornered_facet.stl", 2, 1.0, kOpen},
           Case{"effect_color_blank.dae", 12, 6.0, 1.0},
           Case{"matrix_newline.dae", 12, 6.0, 1.0},
           Case{"utf16.dae", 12, 6.0, 1.0},
       }) {
    SCOPED_TRACE(wanted.name);
    // One coordinate of a cube is -0.5 with the last bit but three of its single precision changed.
    constexpr double kTolerance = 1e-6;
    const SurfaceMesh mesh = weldEqualVertices(importMesh(dataOf("cases/") + wanted.name), wanted.name);
    EXPECT_EQ(mesh.triangleCount(), wanted.triangles);
    EXPECT_NEAR(test::totalArea(mesh), wanted.area, kTolerance * wanted.area);
    EXPECT_NEAR(test::signedVolume(mesh), wanted.volume, kTolerance * wanted.volume);
    EXPECT_EQ(test::isClosedManifold(mesh), wanted.volume != kOpen);
  }
}

TEST(MeshCases, AMatrixAfterANewLineMovesTheBody) {
  const SurfaceMesh cube = weldEqualVertices(importMesh(dataOf("cases/matrix_newline.dae")), "cube");
  EXPECT_EQ(cube.boundingBox().center(), Eigen::Vector3d(1, 2, 3));
}

// ------------------------------------------------------------------------------------------------- PLY

template <typename Number>
void append(std::string& bytes, Number value, bool little_endian) {
  std::array<char, sizeof value> parts{};
  std::memcpy(parts.data(), &value, sizeof value);
  if (!little_endian) std::reverse(parts.begin(), parts.end());
  bytes.append(parts.data(), parts.size());
}

/// Writes the numbers of a PLY body as text or bytes.
class PlyWriter {
 public:
  explicit PlyWriter(std::string format) : format_(std::move(format)) {}

  void add(double value, const std::string& type) {
    const bool little = format_ == "binary_little_endian";
    if (format_ == "ascii") {
      body += std::to_string(value).substr(0, type == "float" || type == "double" ? 8 : 1) + " ";
    } else if (type == "char" || type == "uint8") {
      append(body, static_cast<std::uint8_t>(value), little);
    } else if (type == "short" || type == "uint16") {
      append(body, static_cast<std::uint16_t>(value), little);
    } else if (type == "int" || type == "uint32") {
      append(body, static_cast<std::uint32_t>(value), little);
    } else if (type == "float") {
      append(body, static_cast<float>(value), little);
    } else {
      append(body, value, little);
    }
  }
  void endLine() {
    if (format_ == "ascii") body += "\n";
  }

  std::string body;

 private:
  std::string format_;
};

/// The tetrahedron, among elements and properties that say nothing about it.
std::string plyTetrahedron(const std::string& format, const std::string& coordinate, const std::string& count,
                           const std::string& index) {
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  PlyWriter writer(format);
  for (int i = 0; i < 2; ++i) {  // the element camera, with a list
    writer.add(7, "int");
    writer.add(2, count);
    for (int k = 0; k < 2; ++k) writer.add(1.5, "double");
    writer.endLine();
  }
  for (const auto& corner : corners) {
    writer.add(0.25, "float");
    for (const double value : corner) writer.add(value, coordinate);
    writer.add(1, "uint8");
    writer.endLine();
  }
  for (const auto& face : faces) {
    writer.add(3, count);
    for (int k = 0; k < 3; ++k) writer.add(0.5, "float");  // texture coordinates
    writer.add(3, count);
    for (const int corner : face) writer.add(corner, index);
    writer.endLine();
  }
  return "ply\nformat " + format +
         " 1.0\ncomment a body\nobj_info none\nelement camera 2\nproperty int id\n" + "property list " +
         count + " double view\nelement vertex 4\nproperty float quality\nproperty " + coordinate +
         " x\nproperty " + coordinate + " y\nproperty " + coordinate +
         " z\nproperty uint8 red\nelement face 4\nproperty list " + count +
         " float texcoord\nproperty list " + count + " " + index + " vertex_index\nend_header\n" +
         writer.body;
}

TEST(PlyFiles, AreReadWithAnyTypesAndAmongOtherElements) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string coordinate : {"float", "double", "int", "short"}) {
      for (const std::string count : {"uint8", "char", "short", "uint32"}) {
        for (const std::string index : {"uint8", "short", "uint16", "int", "uint32"}) {
          SCOPED_TRACE(format + " " + coordinate + " " + count + " " + index);
          expectTetrahedron(read(plyTetrahedron(format, coordinate, count, index), ".ply"));
        }
      }
    }
  }
}

TEST(PlyFiles, AreReadWithAnyLineEnds) {
  for (const std::string end : {"\r\n", "\r"}) {
    expectTetrahedron(read(withLineEnds(test::contentOf(dataOf("tetrahedron.ply")), end), ".ply"));
    const std::string binary = plyTetrahedron("binary_big_endian", "float", "uint8", "int");
    const std::size_t body = binary.find("end_header\n") + 11;
    expectTetrahedron(read(withLineEnds(binary.substr(0, body), end) + binary.substr(body), ".ply"));
  }
}

const std::string kFlatPly =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n3 0 1 2\n";

TEST(PlyFiles, FacesMayComeBeforeVertices) {
  EXPECT_EQ(
      read("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
           "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
           ".ply")
          .triangles.size(),
      1U);
}

TEST(PlyFiles, StripsAlternateTheirWindingAndBeginAnewAfterMinusOne) {
  const std::string strips = test::replaced(kFlatPly, "element face 1", "element tristrips 2");
  const auto area_of = [&](const std::string& body, const std::string& type) {
    const std::string with_type = test::replaced(strips, "uchar int", "uchar " + type);
    const SurfaceMesh mesh =
        weldEqualVertices(read(test::replaced(with_type, "3 0 1 2\n", body), ".ply"), "strips");
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) area += test::areaVector(mesh, t).z();
    return area;
  };
  EXPECT_EQ(area_of("6 0 1 2 3 4 5\n0\n", "int"), 2.0);
  EXPECT_EQ(area_of("9 0 1 2 3 -1 2 3 4 5\n0\n", "int"), 2.0);
  EXPECT_EQ(area_of("9 0 1 2 3 4294967295 2 3 4 5\n0\n", "uint"), 2.0);
  EXPECT_EQ(area_of("4 0 1 2 3\n4 2 3 4 5\n", "int"), 2.0);
  // Repeated corners lead on without a triangle.
  EXPECT_EQ(area_of("8 0 1 2 3 3 3 3 5\n0\n", "int"), 1.0);
  EXPECT_TRUE(says(refusalOf(test::replaced(strips, "3 0 1 2\n", "3 0 1 9\n0\n"), ".ply"), "vertex 9 of 6"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(strips, "3 0 1 2\n", "3 0 1 -2\n0\n"), ".ply"), "vertex -2 of 6"));
}

TEST(PlyFiles, AreRefusedWhereTheHeaderAndTheBodyDisagree) {
  EXPECT_TRUE(says(refusalOf(kFlatPly + "3 3 4 5\n", ".ply"), "more elements than its header"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "face 1", "face 2"), ".ply"), "'face' 1 of 2"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(kFlatPly, "1 2 0\n", "1 2 0 255\n"), ".ply"), "'255' in line 15"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "1 2 0\n", "1 2,5 0\n"), ".ply"), "'2,5'"));
  const std::string binary = plyTetrahedron("binary_little_endian", "float", "uint8", "int");
  EXPECT_TRUE(says(refusalOf(binary.substr(0, binary.size() - 1), ".ply"), "'face' 3 of 4"));
  EXPECT_TRUE(says(refusalOf(binary + binary.substr(binary.size() - 30), ".ply"), "30 bytes after"));
  expectTetrahedron(read(binary + "\n", ".ply"));
}

TEST(PlyFiles, AreRefusedByNameWhereTheirFacesWouldBeLost) {
  const auto with_element = [](const std::string& element) {
    return test::replaced(kFlatPly, "element face", "element " + element);
  };
  EXPECT_TRUE(says(refusalOf(with_element("range_grid"), ".ply"), "'range_grid'"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(kFlatPly, "vertex_indices", "corners"), ".ply"), "'vertex_indices'"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "float z", "float depth"), ".ply"), "'z'"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "float z", "half z"), ".ply"), "'half'"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "uchar int", "float int"), ".ply"), "'float'"));
  EXPECT_TRUE(says(refusalOf(test::replaced(kFlatPly, "ascii", "text"), ".ply"), "'text'"));
}

// ------------------------------------------------------------------------------------------------- STL

TEST(StlFiles, AreReadInEveryWayTheyAreWritten) {
  const std::string usual = test::contentOf(dataOf("tetrahedron_ascii.stl"));
  std::string capitals = usual;
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string two_words = usual;
  for (const std::string word : {"facet", "loop", "solid"}) {
    for (std::size_t at = 0; (at = two_words.find("end" + word, at)) != std::string::npos;) {
      two_words.insert(at + 3, " ");
    }
  }
  const std::string name = usual.substr(0, usual.find('\n'));
  for (const std::string& text : {
           usual,
           capitals,
           two_words,
           withLineEnds(usual, "\r\n"),
           withLineEnds(usual, "\r"),
           withLineEnds(usual, " "),
           "\xef\xbb\xbf" + usual,
           "\n \t\n" + usual,
           usual + std::string(10'000, '\n') + std::string(10, '\0'),
           usual + "written by a program that signs its files\n",
           test::replaced(usual, name, "solid"),
           test::replaced(usual, name, "solid a facet of endsolid"),
           test::replaced(usual, name, name + "\ncolor 0.5 0.5 0.5"),
       }) {
    SCOPED_TRACE(text.substr(0, 100));
    expectTetrahedron(read(text, ".stl"));
  }
}

const std::string kFacet =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(StlFiles, TheirCornersDecideAndNotTheirNormals) {
  const std::string text = test::replaced(kFacet, "normal 0 0 1", "normal nan inf -nan(ind)") + "endsolid";
  EXPECT_EQ(read(text, ".stl").triangles.size(), 1U);
  EXPECT_EQ(read(test::replaced(kFacet, "0 1 0", "+0.0 1e+0 1e-999") + "endsolid", ".stl").vertices[2],
            Eigen::Vector3d(0, 1, 0));
}

TEST(StlFiles, AreRefusedWithTheLine) {
  const std::string usual = test::contentOf(dataOf("tetrahedron_ascii.stl"));
  const std::string& facet = kFacet;
  EXPECT_TRUE(says(refusalOf(facet, ".stl"), "breaks off in line 9"));
  EXPECT_TRUE(says(refusalOf(usual + facet.substr(6), ".stl"), "a facet after the end"));
  EXPECT_TRUE(says(refusalOf(test::replaced(facet, "vertex 0 1 0\n", "") + "endsolid", ".stl"),
                   "line 2 has 2 corners"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(facet, "0 1 0", "0 1,5 0") + "endsolid", ".stl"), "line 6 has '1,5'"));
  EXPECT_TRUE(says(refusalOf(test::replaced(facet, "0 1 0", "0 nan 0") + "endsolid", ".stl"), "not finite"));
  EXPECT_TRUE(says(refusalOf(test::replaced(facet, "0 1 0", "0 1e999 0") + "endsolid", ".stl"), "line 6"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(facet, "outer", "inner") + "endsolid", ".stl"), "line 3 has 'inner'"));
}

TEST(StlFiles, BinaryOnesMayBeFollowedByLessThanAFacetOrPadding) {
  const std::string cube = test::contentOf(dataOf("cases/bin_trailing_1.stl")).substr(0, 684);
  for (const std::string header : {"", "solid cube"}) {
    const std::string whole = header + cube.substr(header.size());
    for (const std::string& tail : {std::string(), std::string(49, 'x'), std::string(5000, '\0')}) {
      EXPECT_EQ(read(whole + tail, ".stl").triangles.size(), 12U);
    }
    EXPECT_TRUE(says(refusalOf(whole + std::string(50, 'x'), ".stl"), "12 triangles"));
    EXPECT_TRUE(says(refusalOf(whole.substr(0, 683), ".stl"), "breaks off"));
  }
}

// ------------------------------------------------------------------------------------------------- OBJ

TEST(ObjFiles, AreReadInEveryWayTheyAreWritten) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n";
  const std::string faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  for (const std::string& text : {
           "\xef\xbb\xbf" + vertices + faces,
           withLineEnds(vertices + faces, "\r\n"),
           withLineEnds(vertices + faces, "\r"),
           faces + vertices,
           vertices + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1",
           vertices + "vt 0 0\nvn 0 0 1\nf 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 1/1 4/1 3/1\nf 2/ 3/ 4/\n",
           vertices + "g a b\ns off\no c\nusemtl d\nmtllib e.mtl\np 1\nl 1 2\nf 1 2\n" + faces,
           vertices + "f 1 \\\n3 2 # f 1 2 3\nf 1 2\\\n 4\n# \\\nf 1 4 3\n  f\t2 3 4  \\\n",
           "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 4 0 2\nv 0 0 3 0.1 0.2 0.3 1\n" + faces,
       }) {
    SCOPED_TRACE(text);
    expectTetrahedron(read(text, ".obj"));
  }
}

TEST(ObjFiles, AreRefusedWithTheLine) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_TRUE(says(refusalOf(triangle + "f 1 2 4\n", ".obj"), "line 5 refers to vertex 4 of 3"));
  EXPECT_TRUE(says(refusalOf(triangle + "f 1 2 -4\n", ".obj"), "line 5 has '-4'"));
  EXPECT_TRUE(says(refusalOf(triangle + "f 1 2 0\n", ".obj"), "line 5 has '0'"));
  EXPECT_TRUE(says(refusalOf(triangle + "f 1 2 3.5\n", ".obj"), "line 5 has '3.5'"));
  EXPECT_TRUE(says(refusalOf(triangle + "v 0 0\n", ".obj"), "line 5 has an end"));
  EXPECT_TRUE(says(refusalOf(triangle + "v 0 0,5 1\n", ".obj"), "line 5 has '0,5'"));
  EXPECT_TRUE(says(refusalOf(triangle + "v 0 0 1 0\n", ".obj"), "line 5 has '0'"));
  EXPECT_TRUE(
      says(refusalOf(triangle + "surf 0 1 0 1 1 2 3 4\n", ".obj"), "line 5 is a surface of free form"));
}

// ------------------------------------------------------------------------------------------------- DAE

std::string inUtf16(const std::string& text, bool little_endian, bool with_mark) {
  std::string wide = with_mark ? (little_endian ? "\xff\xfe" : "\xfe\xff") : "";
  for (const char c : text) append(wide, static_cast<std::uint16_t>(c), little_endian);
  return wide;
}

TEST(DaeFiles, AreReadInEveryWayXmlAllows) {
  const std::string usual = test::contentOf(dataOf("tetrahedron.dae"));
  std::string blanks;
  for (const char c : usual) blanks += c == '>' ? ">\n \t" : std::string(1, c);
  std::string comments = usual;
  for (const std::string tag : {"<p>", "<translate>", "<scale>"}) {
    comments = test::replaced(comments, tag, tag + "<!-- numbers -->");
  }
  comments = test::replaced(comments, "0 2 1", "0<!-- a face --> 2 1");
  comments = test::replaced(comments, "-250 0 0", "-250 <!-- x of a vertex -->0 0");
  for (const std::string& text :
       {blanks, comments, withLineEnds(usual, "\r\n"), withLineEnds(usual, "\r"), "\xef\xbb\xbf" + usual,
        inUtf16(usual, true, true), inUtf16(usual, false, true), inUtf16(usual, true, false),
        inUtf16(usual, false, false)}) {
    SCOPED_TRACE(text.substr(0, 200));
    expectTetrahedron(read(text, ".dae"));
  }
}

TEST(DaeFiles, AreRefusedWhereAPartOfTheSurfaceWouldBeLost) {
  const std::string usual = test::contentOf(dataOf("tetrahedron.dae"));
  EXPECT_TRUE(
      says(refusalOf(test::replaced(usual, "<p>", "<ph><p>0 1 2</p><h>0</h></ph><p>"), ".dae"), "<ph>"));
  EXPECT_TRUE(says(refusalOf(test::replaced(usual, "</geometry>", "<brep/></geometry>"), ".dae"), "<brep>"));
  const std::string input = "<input semantic=\"VERTEX\" source=\"#vertices\" offset=\"0\"/>";
  const auto with = [&](const std::string& lists) {
    return test::replaced(usual, "</mesh>", lists + "</mesh>");
  };
  EXPECT_TRUE(says(refusalOf(with("<triangles>" + input + "<p>0 1 2</p></triangles>"), ".dae"),
                   "<triangles> does not state its count"));
  EXPECT_TRUE(says(refusalOf(with("<triangles count=\"0\">" + input + "<p>0 1 2</p></triangles>"), ".dae"),
                   "count of 0"));
  for (const std::string kind : {"tristrips", "trifans", "polygons"}) {
    const std::string lists = input + "<p>0 1 2</p><p>0 1 3</p></" + kind + ">";
    EXPECT_EQ(read(with("<" + kind + " count=\"2\">" + lists), ".dae").triangles.size(), 6U);
    EXPECT_TRUE(says(refusalOf(with("<" + kind + " count=\"1\">" + lists), ".dae"), "has 2 <p>"));
  }
}

TEST(DaeFiles, ReadNothingBeyondTheirArrays) {
  // Vertex 4 is none of the array's four, whatever the accessor says.
  const std::string usual = test::contentOf(dataOf("tetrahedron.dae"));
  const std::string longer = test::replaced(usual, "count=\"4\" stride=\"3\"", "count=\"6\" stride=\"3\"");
  expectTetrahedron(read(longer, ".dae"));
  EXPECT_TRUE(says(refusalOf(test::replaced(longer, "<p>0 2 1", "<p>0 2 4"), ".dae"), "4"));
}

// ---------------------------------------------------------------------------------------------- Locales

class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(MeshFiles, AreReadAlikeInALocaleWithDecimalCommas) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  EXPECT_EQ(read("v 1234.5 0 0\nv 0 0.25 0\nv 0 0 0\nf 1 2 3\n", ".obj").vertices[1].y(), 0.25);
  for (const std::string name :
       {"tetrahedron.obj", "tetrahedron.ply", "tetrahedron_ascii.stl", "tetrahedron.dae"}) {
    SCOPED_TRACE(name);
    expectTetrahedron(read(test::contentOf(dataOf(name)), name.substr(name.size() - 4)));
  }
  std::locale::global(before);
}

}  // namespace
}  // namespace concave_distance::mesh_cases_test
