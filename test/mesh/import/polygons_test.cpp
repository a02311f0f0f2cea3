// Polygons of mesh files against closed forms: skylines, walls with windows, stars, warped and broken ones.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/import/import_worker/cut_polygon.h"
#include "mesh/import/import_worker/read_mesh.h"
#include "support/case_seed.h"
#include "support/mesh_measures.h"

namespace concave_distance::polygons_test {
namespace {

using Face = std::vector<std::uint32_t>;

/// A body of polygons as a program would write it.
struct PolygonBody {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
};

template <typename Body>
std::string textOf(int digits, const Body& write) {
  std::ostringstream text;
  text.precision(digits);
  write(text);
  return text.str();
}

void writeVertices(std::ostream& text, const PolygonBody& body, const char* before) {
  for (const auto& v : body.vertices) text << before << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
}

void writeFaces(std::ostream& text, const PolygonBody& body, unsigned first) {
  for (const Face& face : body.faces) {
    if (first == 1) {
      text << 'f';
    } else {
      text << face.size();
    }
    for (const std::uint32_t corner : face) text << ' ' << corner + first;
    text << '\n';
  }
}

std::string objOf(const PolygonBody& body, int digits = 17) {
  return textOf(digits, [&](std::ostream& text) {
    writeVertices(text, body, "v ");
    writeFaces(text, body, 1);
  });
}

std::string plyOf(const PolygonBody& body) {
  return textOf(17, [&](std::ostream& text) {
    text << "ply\nformat ascii 1.0\nelement vertex " << body.vertices.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << body.faces.size()
         << "\nproperty list int int vertex_indices\nend_header\n";
    writeVertices(text, body, "");
    writeFaces(text, body, 0);
  });
}

std::string daeOf(const PolygonBody& body) {
  return textOf(9, [&](std::ostream& text) {
    text
        << R"(<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries>)"
        << R"(<geometry id="g"><mesh><source id="p"><float_array id="a" count=")" << 3 * body.vertices.size()
        << "\">";
    writeVertices(text, body, "");
    text << R"(</float_array><technique_common><accessor source="#a" count=")" << body.vertices.size()
         << R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>)"
         << R"(<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v">)"
         << R"(<input semantic="POSITION" source="#p"/></vertices><polylist count=")" << body.faces.size()
         << R"("><input semantic="VERTEX" source="#v" offset="0"/><vcount>)";
    for (const Face& face : body.faces) text << face.size() << ' ';
    text << "</vcount><p>";
    for (const Face& face : body.faces) {
      for (const std::uint32_t corner : face) text << corner << ' ';
    }
    text << R"(</p></polylist></mesh></geometry></library_geometries><library_visual_scenes>)"
         << R"(<visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>)"
         << R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  });
}

TriangleSoup soupOf(const std::string& content, const std::string& extension) {
  return detail::readMesh(content, "polygons", extension, Eigen::Vector3d::Ones(), 10'000'000);
}

SurfaceMesh meshOf(const std::string& content, const std::string& extension) {
  return weldEqualVertices(soupOf(content, extension), "polygons");
}

/// Rounding leaves triangles without area beside corners within an edge; repair takes them out.
SurfaceMesh repairedMeshOf(const std::string& content, const std::string& extension) {
  return repairMesh(soupOf(content, extension), {}, "polygons").mesh;
}

std::string whyRefused(const std::string& content, const std::string& extension) {
  try {
    soupOf(content, extension);
  } catch (const Error& error) {
    return error.whatIsWrong();
  }
  return "accepted";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The prism between z = 0 and z = depth over an outline that runs counter-clockwise.
PolygonBody prismOver(const std::vector<Eigen::Vector2d>& outline, double depth, std::uint32_t first_corner) {
  PolygonBody body;
  const auto count = static_cast<std::uint32_t>(outline.size());
  Face bottom;
  Face top;
  for (const double z : {0.0, depth}) {
    for (const auto& p : outline) body.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t corner = (i + first_corner) % count;
    const std::uint32_t next = (corner + 1) % count;
    bottom.insert(bottom.begin(), corner);
    top.push_back(count + corner);
    body.faces.push_back({corner, next, count + next, count + corner});
  }
  body.faces.push_back(bottom);
  body.faces.push_back(top);
  return body;
}

/// Houses side by side, of whole-number width and height; those of equal height leave a corner within an
/// edge.
struct Skyline {
  std::vector<int> left;  ///< of each house, and the right end of the last one
  std::vector<int> height;
  int depth = 1;

  explicit Skyline(RandomEngine& engine) {
    const std::uint32_t count = 2 + uniformIndex(engine, 12);
    left.push_back(0);
    for (std::uint32_t i = 0; i < count; ++i) {
      left.push_back(left.back() + 1 + static_cast<int>(uniformIndex(engine, 3)));
      height.push_back(1 + static_cast<int>(uniformIndex(engine, 6)));
    }
    depth += static_cast<int>(uniformIndex(engine, 3));
  }

  std::vector<Eigen::Vector2d> outline() const {
    std::vector<Eigen::Vector2d> corners{{0, 0}, {left.back(), 0}};
    for (std::size_t i = height.size(); i-- > 0;) {
      corners.emplace_back(left[i + 1], height[i]);
      corners.emplace_back(left[i], height[i]);
    }
    return corners;
  }

  double front() const {
    int area = 0;
    for (std::size_t i = 0; i < height.size(); ++i) area += (left[i + 1] - left[i]) * height[i];
    return area;
  }

  double border() const {
    int length = 2 * left.back() + height.front() + height.back();
    for (std::size_t i = 1; i < height.size(); ++i) length += std::abs(height[i] - height[i - 1]);
    return length;
  }

  double area() const { return 2.0 * front() + border() * depth; }
  double volume() const { return front() * depth; }

  /// To the union of the houses, 0 inside.
  double distanceTo(const Eigen::Vector3d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < height.size(); ++i) {
      const Eigen::AlignedBox3d house(Eigen::Vector3d(left[i], 0, 0),
                                      Eigen::Vector3d(left[i + 1], height[i], depth));
      least = std::min(least, house.exteriorDistance(p));
    }
    return least;
  }
};

/// A rotation of the cube: whole numbers stay whole.
Eigen::Matrix3d randomQuarterTurns(RandomEngine& engine) {
  const auto axis = static_cast<int>(uniformIndex(engine, 3));
  const double sign = uniformIndex(engine, 2) == 0 ? 1.0 : -1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(0, axis) = sign;
  turn(1, (axis + 1) % 3) = 1.0;
  turn(2, (axis + 2) % 3) = sign;
  return turn;
}

Eigen::Matrix3d randomTurn(RandomEngine& engine) {
  return Eigen::Quaterniond(Eigen::Vector4d(uniformUnit(engine) - 0.5, uniformUnit(engine) - 0.5,
                                            uniformUnit(engine) - 0.5, uniformUnit(engine) - 0.5)
                                .normalized())
      .toRotationMatrix();
}

/// An outline's outside is compared where it matters: near it.
void expectSkyline(const SurfaceMesh& mesh, const Skyline& skyline, const Eigen::Matrix3d& turn,
                   RandomEngine& engine, double tolerance) {
  EXPECT_NEAR(test::totalArea(mesh), skyline.area(), tolerance * skyline.area());
  EXPECT_NEAR(test::signedVolume(mesh), skyline.volume(), tolerance * skyline.volume());
  EXPECT_TRUE(test::isClosedManifold(mesh));
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d p((skyline.left.back() + 2) * uniformUnit(engine) - 1.0,
                            8.0 * uniformUnit(engine) - 1.0, (skyline.depth + 2) * uniformUnit(engine) - 1.0);
    const double distance = skyline.distanceTo(p);
    if (distance == 0.0) continue;
    EXPECT_NEAR(test::distanceToSurface(turn * p, mesh), distance, 10.0 * tolerance);
  }
}

TEST(Polygons, SkylinesHaveTheirAreaVolumeAndDistancesInEveryFormat) {
  RandomEngine engine(test::caseSeed(33));
  const int count = test::caseCount(300);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const Skyline skyline(engine);
    const auto outline = skyline.outline();
    const Eigen::Matrix3d turn = randomQuarterTurns(engine);
    PolygonBody body =
        prismOver(outline, skyline.depth, uniformIndex(engine, static_cast<std::uint32_t>(outline.size())));
    for (Eigen::Vector3d& v : body.vertices) v = turn * v;
    constexpr double kRounding = 1e-13;  // of sums of whole numbers' square roots and products
    expectSkyline(meshOf(objOf(body), ".obj"), skyline, turn, engine, kRounding);
    expectSkyline(meshOf(plyOf(body), ".ply"), skyline, turn, engine, kRounding);
    expectSkyline(meshOf(daeOf(body), ".dae"), skyline, turn, engine, kRounding);
  }
}

TEST(Polygons, TurnedSkylinesAreCutWhateverRoundingMakesOfTheirEdges) {
  RandomEngine engine(test::caseSeed(34));
  const int count = test::caseCount(300);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const Skyline skyline(engine);
    const Eigen::Matrix3d turn = randomTurn(engine);
    PolygonBody body = prismOver(skyline.outline(), skyline.depth, 0);
    for (Eigen::Vector3d& v : body.vertices) v = turn * v;
    expectSkyline(repairedMeshOf(objOf(body), ".obj"), skyline, turn, engine, 1e-12);
    // As single precision leaves it, and with six digits, the fewest that programs write by default.
    expectSkyline(repairedMeshOf(objOf(body, 8), ".obj"), skyline, turn, engine, 1e-6);
    expectSkyline(repairedMeshOf(objOf(body, 6), ".obj"), skyline, turn, engine, 1e-4);
  }
}

TEST(Polygons, WallsKeepTheirWindowsBehindSeamsPassedTwice) {
  RandomEngine engine(test::caseSeed(35));
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const int windows = 1 + static_cast<int>(uniformIndex(engine, 5));
    std::vector<Eigen::Vector2d> outline{{0, 0}};
    std::vector<Eigen::Vector2d> centres;
    for (int w = 0; w < windows; ++w) {
      const double x = 4 * w + 1;
      const double y = 1 + uniformIndex(engine, 4);
      outline.insert(outline.end(), {{x, 0}, {x, y}, {x, y + 2}, {x + 2, y + 2}, {x + 2, y}, {x, y}, {x, 0}});
      centres.emplace_back(x + 1, y + 1);
    }
    const double width = 4 * windows;
    outline.insert(outline.end(), {{width, 0}, {width, 8}, {0, 8}});
    const Eigen::Matrix3d turn = i % 2 == 0 ? randomQuarterTurns(engine) : randomTurn(engine);
    PolygonBody wall;
    Face face;
    const std::uint32_t first = uniformIndex(engine, static_cast<std::uint32_t>(outline.size()));
    for (std::uint32_t k = 0; k < outline.size(); ++k) {
      const auto& p = outline[(k + first) % outline.size()];
      face.push_back(k);
      wall.vertices.push_back(turn * Eigen::Vector3d(p.x(), p.y(), 0.0));
    }
    wall.faces = {face};
    const SurfaceMesh mesh = repairedMeshOf(objOf(wall), ".obj");
    EXPECT_NEAR(test::totalArea(mesh), 8 * width - 4 * windows, 1e-12 * width);
    for (const auto& c : centres) {
      EXPECT_NEAR(test::distanceToSurface(turn * Eigen::Vector3d(c.x(), c.y(), 0), mesh), 1.0, 1e-12 * width);
    }
  }
}

struct Cut {
  bool is_cut;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Eigen::Vector3d newell = Eigen::Vector3d::Zero();
  double area = 0.0;
  double least_share = 1.0;  ///< of a triangle's area that faces Newell's normal
};

Cut cut(const std::vector<Eigen::Vector3d>& corners) {
  Cut result{};
  Face face;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    face.push_back(i);
    result.newell += 0.5 * corners[i].cross(corners[(i + 1) % corners.size()]);
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : corners) box.extend(corner);
  detail::PolygonCutter cutter(kSinglePrecisionWeld * box.diagonal().norm());
  result.is_cut = cutter.cut(corners, face.data(), face.size(), result.triangles);
  for (const auto& t : result.triangles) {
    const Eigen::Vector3d area = test::areaVector(corners[t[0]], corners[t[1]], corners[t[2]]);
    result.area += area.norm();
    result.least_share = std::min(result.least_share, area.dot(result.newell.normalized()) / area.norm());
  }
  return result;
}

TEST(Polygons, StarsAnywhereInSpaceHaveNewellsAreaAndTwoTrianglesFewerThanCorners) {
  RandomEngine engine(test::caseSeed(36));
  const int count = test::caseCount(500);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const std::uint32_t corners = 4 + uniformIndex(engine, 40);
    const Eigen::Matrix3d turn = randomTurn(engine);
    const Eigen::Vector3d place = Eigen::Vector3d::Constant(100.0 * uniformUnit(engine));
    std::vector<Eigen::Vector3d> star;
    for (std::uint32_t k = 0; k < corners; ++k) {
      const double angle = 2.0 * M_PI * (k + 0.9 * uniformUnit(engine)) / corners;
      star.push_back(place + (0.1 + uniformUnit(engine)) *
                                 (turn * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)));
    }
    const Cut result = cut(star);
    ASSERT_TRUE(result.is_cut);
    EXPECT_EQ(result.triangles.size(), corners - 2);
    EXPECT_NEAR(result.area, result.newell.norm(), 1e-11);
    EXPECT_GT(result.least_share, 0.0);
  }
}

TEST(Polygons, WarpedOnesAreCutSoThatTheirTrianglesFaceNewellsNormal) {
  RandomEngine engine(test::caseSeed(37));
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    // Quads as thin as 1:100, warped by up to half of their width, and pentagons.
    const double width = std::pow(10.0, -2.0 * uniformUnit(engine));
    const double warp = 0.5 * width * uniformUnit(engine);
    const Eigen::Matrix3d turn = randomTurn(engine);
    std::vector<Eigen::Vector3d> corners{{0, 0, warp}, {1, 0, -warp}, {1, width, warp}, {0, width, -warp}};
    if (i % 3 == 0) corners.emplace_back(-0.5, 0.5 * width, 0.3 * warp);
    for (Eigen::Vector3d& corner : corners) corner = turn * corner;
    const Cut result = cut(corners);
    ASSERT_TRUE(result.is_cut);
    EXPECT_EQ(result.triangles.size(), corners.size() - 2);
    EXPECT_GT(result.least_share, 0.0);
  }
}

TEST(Polygons, OfFourCornersAreCutHoweverWarped) {
  RandomEngine engine(test::caseSeed(38));
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    // A field of heights much larger than its steps.
    std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (Eigen::Vector3d& corner : corners) corner.z() = 100.0 * uniformUnit(engine);
    const Cut result = cut(corners);
    ASSERT_TRUE(result.is_cut);
    ASSERT_EQ(result.triangles.size(), 2U);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& t : result.triangles)
      sum += test::areaVector(corners[t[0]], corners[t[1]], corners[t[2]]);
    EXPECT_LE((sum - result.newell).norm(), 1e-10);
  }
}

TEST(Polygons, ThatCrossThemselvesAreRefusedWithTheirPlace) {
  const PolygonBody bow{{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}};
  const PolygonBody eight{{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}};
  for (const PolygonBody& body : {bow, eight}) {
    EXPECT_TRUE(
        mentions(whyRefused(objOf(body), ".obj"), "line 5 is a polygon of 4 corners whose border crosses"));
    EXPECT_TRUE(mentions(whyRefused(plyOf(body), ".ply"), "face 0 is a polygon of 4 corners"));
    EXPECT_TRUE(mentions(whyRefused(daeOf(body), ".dae"), "face 0 of mesh 'g' is a polygon of 4 corners"));
  }
  // A tenth of a millimetre is no rounding of a metre.
  for (const double size : {1e-4, 1e-6}) {
    EXPECT_FALSE(cut({{0, 0, 0},
                      {1, 0, 0},
                      {1, 1, 0},
                      {size, 1, 0},
                      {0, 1 - size, 0},
                      {0, 1, 0},
                      {size, 1 - size, 0},
                      {0, 0.5, 0}})
                     .is_cut)
        << size;
  }
}

TEST(Polygons, RepeatedCornersSpikesAndHolesThatTouchTheBorderAreNoObstacle) {
  const double side = 4.0;
  const std::vector<Eigen::Vector3d> square{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
  const auto with = [&](const std::vector<Eigen::Vector3d>& more) {
    std::vector<Eigen::Vector3d> corners = square;
    corners.insert(corners.end(), more.begin(), more.end());
    return cut(corners);
  };
  for (const Cut& result : {
           with({{0, side, 0}, {0, 0, 0}, {0, 0, 0}}),                                // corners twice
           with({{0, 2, 0}, {0, 1, 0}}),                                              // within an edge
           with({{0, 2, 0}, {-3, 2, 0}, {0, 2, 0}}),                                  // a spike outwards
           with({{0, 2, 0}, {3, 2, 0}, {0, 2, 0}}),                                   // and inwards
           with({{0, 2, 0}, {2, 2, 0}, {2, 3, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}),  // branched
       }) {
    EXPECT_TRUE(result.is_cut);
    EXPECT_NEAR(result.area, 16.0, 1e-14);
  }
  const Cut hole = with({{0, 0, 0}, {1, 2, 0}, {2, 1, 0}});
  EXPECT_TRUE(hole.is_cut);
  EXPECT_NEAR(hole.area, 16.0 - 1.5, 1e-14);
  // Without any area: nothing, or triangles that repair drops.
  for (const Cut& result : {cut({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}),
                            cut({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}})}) {
    EXPECT_TRUE(result.is_cut);
    EXPECT_EQ(result.area, 0.0);
  }
}

TEST(Polygons, OfThousandsOfCornersTakeNoTime) {
  constexpr std::uint32_t kCorners = 20'000;
  std::vector<Eigen::Vector3d> disc;
  std::vector<Eigen::Vector3d> saw;
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    disc.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    if (i < kCorners / 5) saw.emplace_back(kCorners / 5 - i, i % 2 == 0 ? 1.0 : 100.0, 0.0);
  }
  saw.emplace_back(0.0, 0.0, 0.0);
  saw.emplace_back(kCorners / 5, 0.0, 0.0);
  for (const auto& corners : {disc, saw}) {
    const Cut result = cut(corners);
    EXPECT_TRUE(result.is_cut);
    EXPECT_EQ(result.triangles.size(), corners.size() - 2);
    EXPECT_NEAR(result.area, result.newell.norm(), 1e-9 * result.area);
  }
}

}  // namespace
}  // namespace concave_distance::polygons_test
