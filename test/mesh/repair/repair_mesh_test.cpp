#include "concave_distance/mesh/repair/repair_mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/surface/mesh_topology.h"
#include "support/mesh_measures.h"
#include "support/mesh_variants.h"

namespace concave_distance::repair_mesh_test {
namespace {

/// As an STL file holds it: three vertices of its own for each triangle.
TriangleSoup unwelded(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  for (const TriangleNodes& t : mesh.triangles()) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const NodeIndex node : t) soup.vertices.push_back(mesh.vertex(node));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

void append(TriangleSoup& soup, const SurfaceMesh& mesh, const Eigen::Vector3d& shift, bool turned = false) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices()) soup.vertices.push_back(v + shift);
  for (const TriangleNodes& t : mesh.triangles()) {
    soup.triangles.push_back(
        {first + t[0].value, first + t[turned ? 2 : 1].value, first + t[turned ? 1 : 2].value});
  }
}

RepairedMesh repair(const TriangleSoup& soup, double weld_tolerance = 0.0) {
  RepairOptions options;
  options.weld_tolerance = weld_tolerance;
  return repairMesh(soup, options, "test soup");
}

const SurfaceMesh& unitCube() {
  static const SurfaceMesh cube = makeBox({1.0, 1.0, 1.0});
  return cube;
}

TEST(RepairMesh, WeldsAnStlIntoOneClosedShell) {
  const RepairedMesh repaired = repair(unwelded(unitCube()));
  EXPECT_EQ(repaired.mesh.vertexCount(), 8U);
  EXPECT_EQ(repaired.mesh.triangleCount(), 12U);
  EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
  EXPECT_EQ(repaired.report.vertices_in, 36U);
  EXPECT_EQ(repaired.report.triangles_in, 12U);
  EXPECT_EQ(repaired.report.welded_vertices, 28U);
  EXPECT_EQ(repaired.report.shells, 1U);
  EXPECT_EQ(repaired.report.closed_shells, 1U);
  EXPECT_EQ(repaired.report.turned_triangles, 0U);
}

TEST(RepairMesh, WeldsZeroAndMinusZero) {
  TriangleSoup soup{{{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, 0}, {1, 0, 0}, {0, 0, 1}},
                    {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(repair(soup).mesh.vertexCount(), 4U);
}

TEST(RepairMesh, ClosesTheSlitsOfRoundedCornersAndMovesNoVertexFartherThanTheTolerance) {
  TriangleSoup soup = unwelded(makeSphere(0.3, 0.01));
  for (std::size_t i = 0; i < soup.vertices.size(); i += 7) {  // some corners come out one unit off
    const auto x = static_cast<float>(soup.vertices[i].x());
    soup.vertices[i].x() = static_cast<double>(std::nextafter(x, 1.0F));
  }
  EXPECT_GT(repair(soup).report.border_edges, 0U);
  EXPECT_EQ(repair(soup).report.largest_move, 0.0);
  const RepairedMesh welded = repair(soup, kSinglePrecisionWeld);
  EXPECT_TRUE(test::isClosedManifold(welded.mesh));
  EXPECT_EQ(test::eulerCharacteristic(welded.mesh), 2);
  EXPECT_EQ(welded.report.unused_vertices, 0U);
  EXPECT_EQ(welded.report.welded_vertices, soup.vertices.size() - welded.mesh.vertexCount());
  double farthest = 0.0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& before = soup.vertices[soup.triangles[t][static_cast<std::size_t>(k)]];
      farthest = std::max(farthest, (welded.mesh.corner(TriangleIndex{t}, k) - before).norm());
    }
  }
  EXPECT_EQ(welded.report.largest_move, farthest);
  EXPECT_GT(farthest, 0.0);
  EXPECT_LE(farthest, kSinglePrecisionWeld * 0.6 * std::sqrt(3.0));
}

TEST(RepairMesh, CollapsesNoDetailWithinASurfaceWhenWelding) {
  // A strip a nanometre wide along the edge of a cube: its ends are far closer than the tolerance, but no
  // border.
  const SurfaceMesh cube = makeBox({1.0, 1.0, 1.0});
  TriangleSoup soup = test::soupOf(cube);
  const auto added = static_cast<std::uint32_t>(soup.vertices.size());
  soup.vertices.push_back(soup.vertices[0] + Eigen::Vector3d(1e-9, 1e-9, 1e-9));
  const auto first = soup.triangles.front();  // split into three at a point near its first corner
  soup.triangles.front() = {first[0], first[1], added};
  soup.triangles.push_back({first[1], first[2], added});
  soup.triangles.push_back({first[2], first[0], added});
  const RepairedMesh repaired = repair(soup, 1e-6);
  EXPECT_EQ(repaired.report.welded_vertices, 0U);
  EXPECT_EQ(repaired.mesh.triangleCount(), 14U);
}

TEST(RepairMesh, DropsDuplicatesOfEitherWinding) {
  TriangleSoup soup = test::soupOf(unitCube());
  soup.triangles.push_back(soup.triangles[3]);
  soup.triangles.push_back({soup.triangles[5][1], soup.triangles[5][0], soup.triangles[5][2]});
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.duplicate_triangles, 2U);
  EXPECT_EQ(repaired.mesh.triangles(), unitCube().triangles());
}

TEST(RepairMesh, DropsTrianglesWithoutArea) {
  TriangleSoup soup = test::soupOf(unitCube());
  const auto extra = static_cast<std::uint32_t>(soup.vertices.size());
  soup.vertices.emplace_back(0.5, 0.5, 0.0);  // on the edge between vertices 3 and 7
  soup.triangles.push_back({0, 0, 0});        // a point
  soup.triangles.push_back({1, 2, 1});        // a segment
  soup.triangles.push_back({3, extra, 7});    // three points of a line
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.zero_area_triangles, 3U);
  EXPECT_EQ(repaired.report.unused_vertices, 1U);
  EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
}

// The box's face in front has `count` more corners on its upper edge, the top has none; triangles without
// area close the gap between. `fan`: they have the edge's first corner in common, or follow each other
// otherwise.
TriangleSoup boxClosedByFlatTriangles(std::uint32_t count, bool fan, bool turned) {
  TriangleSoup soup = test::soupOf(unitCube());
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  std::vector<std::uint32_t> chain;
  std::uint32_t ends[2] = {0, 0};
  for (std::uint32_t v = 0; v < first; ++v) {
    if (soup.vertices[v] == Eigen::Vector3d(-0.5, -0.5, 0.5)) ends[0] = v;
    if (soup.vertices[v] == Eigen::Vector3d(0.5, -0.5, 0.5)) ends[1] = v;
  }
  chain.push_back(ends[0]);
  for (std::uint32_t i = 0; i < count; ++i) {
    soup.vertices.emplace_back((i + 1.0) / (count + 1.0) - 0.5, -0.5, 0.5);
    chain.push_back(first + i);
  }
  chain.push_back(ends[1]);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : soup.triangles) {
    const auto lies_in_front = [&](std::uint32_t v) { return soup.vertices[v].y() == -0.5; };
    const bool at_edge =
        std::count(t.begin(), t.end(), ends[0]) + std::count(t.begin(), t.end(), ends[1]) == 2;
    if (!at_edge || !std::all_of(t.begin(), t.end(), lies_in_front)) {
      triangles.push_back(t);
      continue;
    }
    std::size_t apex = 0;
    while (t[apex] == ends[0] || t[apex] == ends[1]) ++apex;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const bool ascends = t[(apex + 1) % 3] == ends[0];
      triangles.push_back({t[apex], chain[ascends ? i : i + 1], chain[ascends ? i + 1 : i]});
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    // Each has the whole rest of the edge on one side: from its start, or from the corner before.
    std::array<std::uint32_t, 3> flat =
        fan ? std::array<std::uint32_t, 3>{chain[0], chain[i + 1], chain[i + 2]}
            : std::array<std::uint32_t, 3>{chain[i], chain[i + 1], chain.back()};
    if (turned) std::swap(flat[0], flat[1]);
    triangles.push_back(flat);
  }
  soup.triangles = triangles;
  return soup;
}

TEST(RepairMesh, WhatTrianglesWithoutAreaCloseStaysClosed) {
  for (const std::uint32_t count : {1U, 2U, 9U}) {
    for (const bool fan : {false, true}) {
      for (const bool turned : {false, true}) {
        const RepairedMesh repaired = repair(boxClosedByFlatTriangles(count, fan, turned));
        EXPECT_EQ(repaired.report.zero_area_triangles, count);
        EXPECT_EQ(repaired.report.split_triangles, count);
        EXPECT_EQ(repaired.report.closed_shells, 1U);
        EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
        EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 1.0);
        EXPECT_DOUBLE_EQ(test::totalArea(repaired.mesh), 6.0);
        EXPECT_EQ(repaired.mesh.triangleCount(), 12U + 2U * count);
      }
    }
  }
}

TEST(RepairMesh, AnyNumberOfTrianglesWithoutAreaEndsSoon) {
  // All share one line of corners, in every order, so that each one split makes further ones.
  TriangleSoup soup = test::soupOf(unitCube());
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  constexpr std::uint32_t kCorners = 300;
  for (std::uint32_t i = 0; i < kCorners; ++i) soup.vertices.emplace_back(i * 0.01, 5.0, 5.0);
  for (std::uint32_t i = 0; i < 40 * kCorners; ++i) {
    soup.triangles.push_back(
        {first + i * 7 % kCorners, first + i * 31 % kCorners, first + (i * 97 + i / kCorners) % kCorners});
  }
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.mesh.triangles(), unitCube().triangles());
}

TEST(RepairMesh, KeepsASliverThatHasAnArea) {
  // coal's sliver: 14.729 m long, 5.3 mm wide; and one a thousand times thinner.
  for (const double width : {5.3e-3, 5.3e-6}) {
    const TriangleSoup soup{{{0, 0, 0}, {14.729, 0, 0}, {7.0, width, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(repair(soup).mesh.triangleCount(), 1U);
  }
}

TEST(RepairMesh, TurnsAnInsideOutShell) {
  TriangleSoup soup;
  append(soup, unitCube(), Eigen::Vector3d::Zero(), true);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.turned_triangles, 12U);
  EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 1.0);
}

RC_GTEST_PROP(RepairMesh, MakesAnyMixtureOfWindingsOutward, ()) {
  TriangleSoup soup = test::soupOf(unitCube());
  std::size_t turned = 0;
  for (auto& t : soup.triangles) {
    if (*rc::gen::arbitrary<bool>()) {
      std::swap(t[0], t[1]);
      ++turned;
    }
  }
  const RepairedMesh repaired = repair(soup);
  RC_ASSERT(repaired.report.turned_triangles == turned);
  RC_ASSERT(test::isClosedManifold(repaired.mesh));
  RC_ASSERT(std::abs(test::signedVolume(repaired.mesh) - 1.0) < 1e-14);
}

RC_GTEST_PROP(RepairMesh, IsIdempotent, ()) {
  TriangleSoup soup;
  const auto count = *rc::gen::inRange<std::uint32_t>(3, 30);
  for (std::uint32_t i = 0; i < 3 * count; ++i) {  // few places, so that vertices and triangles coincide
    const double x = *rc::gen::inRange(0, 3);
    const double y = *rc::gen::inRange(0, 3);
    soup.vertices.emplace_back(x, y, *rc::gen::inRange(0, 3));
  }
  for (std::uint32_t t = 0; t < count; ++t) soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  soup.vertices[0] = {0, 0, 0};
  soup.vertices[1] = {1, 0, 0};
  soup.vertices[2] = {0, 1, 0};
  const RepairedMesh once = repair(soup);
  const RepairedMesh twice = repair(test::soupOf(once.mesh));
  RC_ASSERT(twice.mesh.vertices() == once.mesh.vertices());
  RC_ASSERT(twice.mesh.triangles() == once.mesh.triangles());
  RC_ASSERT(twice.report.turned_triangles == 0U);
  RC_ASSERT(twice.report.shells == once.report.shells);
  RC_ASSERT(twice.report.holes == once.report.holes);
}

RC_GTEST_PROP(RepairMesh, CountsWhatTheTopologyShows, ()) {
  TriangleSoup soup;
  const auto count = *rc::gen::inRange<std::uint32_t>(1, 40);
  for (std::uint32_t i = 0; i < 12; ++i) {
    soup.vertices.emplace_back(std::sin(5.0 * i), std::sin(7.0 * i), std::sin(11.0 * i));
  }
  soup.triangles.push_back({0, 1, 2});
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto a = *rc::gen::inRange<std::uint32_t>(0, 12);
    const auto b = *rc::gen::inRange<std::uint32_t>(0, 12);
    soup.triangles.push_back({a, b, *rc::gen::inRange<std::uint32_t>(0, 12)});
  }
  const RepairedMesh repaired = repair(soup);
  const MeshTopology topology = buildMeshTopology(repaired.mesh);
  RC_ASSERT(repaired.report.shells == topology.shellCount());
  RC_ASSERT(repaired.report.closed_shells ==
            static_cast<std::size_t>(
                std::count(topology.shell_is_closed.begin(), topology.shell_is_closed.end(), true)));
  std::size_t border = 0;
  std::size_t non_manifold = 0;
  for (const auto& [nodes, use] : test::edgeUses(repaired.mesh)) {
    border += use.first + use.second == 1 ? 1U : 0U;
    non_manifold += use.first + use.second > 2 ? 1U : 0U;
  }
  RC_ASSERT(repaired.report.border_edges == border);
  RC_ASSERT(repaired.report.non_manifold_edges == non_manifold);
}

TEST(RepairMesh, OrientsNestedShellsByTurns) {
  // A wall (outer shell and the hollow's shell) with a loose core in the hollow, all inside out, and a lone
  // cube beside them.
  TriangleSoup soup;
  append(soup, makeBox({4, 4, 4}), Eigen::Vector3d::Zero(), true);
  append(soup, makeBox({3, 3, 3}), Eigen::Vector3d::Zero(), false);
  append(soup, makeBox({1, 1, 1}), Eigen::Vector3d::Zero(), true);
  append(soup, makeBox({1, 1, 1}), Eigen::Vector3d(10, 0, 0), true);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.shells, 4U);
  EXPECT_EQ(repaired.report.closed_shells, 4U);
  EXPECT_EQ(repaired.report.turned_triangles, 48U);
  EXPECT_NEAR(test::signedVolume(repaired.mesh), 64.0 - 27.0 + 1.0 + 1.0, 1e-12);
}

TEST(RepairMesh, TakesOverlappingSolidsForSolids) {
  TriangleSoup soup;
  append(soup, makeBox({4, 4, 4}), Eigen::Vector3d::Zero());
  append(soup, makeBox({1, 1, 6}), Eigen::Vector3d::Zero());  // sticks out on both sides
  append(soup, makeBox({1, 1, 2}), Eigen::Vector3d(1.2, 1.2, 1.2));
  EXPECT_EQ(repair(soup).report.turned_triangles, 0U);
}

TEST(RepairMesh, KeepsTheWindingMostTrianglesOfAnOpenSheetHave) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                    {{0, 1, 2}, {0, 2, 3}, {1, 2, 4}}};  // the last one faces down
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.turned_triangles, 1U);
  for (std::size_t t = 0; t < 3; ++t) EXPECT_GT(test::areaVector(repaired.mesh, t).z(), 0.0);
}

TEST(RepairMesh, LeavesTheWindingAloneWhenAskedTo) {
  TriangleSoup soup;
  append(soup, unitCube(), Eigen::Vector3d::Zero(), true);
  RepairOptions options;
  options.orient = false;
  const RepairedMesh repaired = repairMesh(soup, options, "test soup");
  EXPECT_EQ(repaired.report.turned_triangles, 0U);
  EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), -1.0);
}

TEST(RepairMesh, CountsHolesAsLoops) {
  TriangleSoup soup = test::soupOf(makeSphere(1.0, 0.01));
  // The two ends of the list are at opposite poles: two far holes.
  soup.triangles.erase(soup.triangles.begin());
  soup.triangles.pop_back();
  const RepairReport report = repair(soup).report;
  EXPECT_EQ(report.holes, 2U);
  EXPECT_EQ(report.border_edges, 6U);
  EXPECT_EQ(report.shells, 1U);
  EXPECT_EQ(report.closed_shells, 0U);
}

TEST(RepairMesh, FollowsTheRimOfEachSheetThatMeetsInACorner) {
  const TriangleSoup bow_tie{{{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}},
                             {{0, 2, 1}, {0, 3, 4}}};
  const RepairReport report = repair(bow_tie).report;
  EXPECT_EQ(report.shells, 1U);
  EXPECT_EQ(report.holes, 2U);
  EXPECT_EQ(report.border_edges, 6U);
}

TEST(RepairMesh, PassesNoWindingOverAnEdgeOfThreeTriangles) {
  // A cube with a fin on one edge: the cube is closed without the fin and is turned outwards; the fin keeps
  // its winding.
  TriangleSoup soup;
  append(soup, unitCube(), Eigen::Vector3d::Zero(), true);
  soup.vertices.emplace_back(2.0, 2.0, 0.0);
  soup.triangles.push_back({3, 7, 8});
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.non_manifold_edges, 1U);
  EXPECT_EQ(repaired.report.turned_triangles, 12U);
  EXPECT_EQ(repaired.report.shells, 2U);
  EXPECT_EQ(repaired.report.closed_shells, 1U);
  const TriangleNodes fin{NodeIndex{3U}, NodeIndex{7U}, NodeIndex{8U}};
  EXPECT_EQ(repaired.mesh.triangles().back(), fin);
}

TEST(RepairMesh, OrientsTwoSolidsThatTouchAlongAnEdge) {
  TriangleSoup soup;
  append(soup, unitCube(), Eigen::Vector3d::Zero(), true);
  append(soup, unitCube(), Eigen::Vector3d(1, 1, 0), false);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.non_manifold_edges, 1U);
  EXPECT_EQ(repaired.report.turned_triangles, 12U);
  EXPECT_NEAR(test::signedVolume(repaired.mesh), 2.0, 1e-14);
}

TEST(RepairMesh, ReportsWhatCannotBeOriented) {
  TriangleSoup soup;  // a Moebius strip of seven quadrilaterals
  constexpr std::uint32_t kSteps = 7;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / kSteps;
    const Eigen::Vector3d middle(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d across =
        0.3 * (std::cos(0.5 * angle) * middle + std::sin(0.5 * angle) * Eigen::Vector3d::UnitZ());
    soup.vertices.push_back(middle - across);
    soup.vertices.push_back(middle + across);
    const bool last = i + 1 == kSteps;
    const std::uint32_t a = 2 * i;
    const std::uint32_t c = last ? 1 : a + 2;
    const std::uint32_t d = last ? 0 : a + 3;
    soup.triangles.push_back({a, a + 1, d});
    soup.triangles.push_back({a, d, c});
  }
  const RepairReport report = repair(soup).report;
  EXPECT_GE(report.inconsistent_edges, 1U);
  EXPECT_EQ(report.holes, 1U);
  EXPECT_EQ(report.closed_shells, 0U);
}

TEST(RepairMesh, SummaryIsEmptyForASoundMeshAndNamesWhatItFound) {
  EXPECT_EQ(repair(test::soupOf(unitCube())).report.summary(), "");
  TriangleSoup soup = test::soupOf(unitCube());
  soup.triangles.pop_back();
  soup.triangles.push_back(soup.triangles[0]);
  EXPECT_EQ(repair(soup).report.summary(),
            "1 duplicate triangle dropped, 1 open shell, 1 hole, 3 border edges");
}

TEST(RepairMesh, RefusesASoupWithNothingLeft) {
  EXPECT_THROW(repair({}), Error);
  EXPECT_THROW(repair({{{0, 0, 0}, {1, 0, 0}}, {}}), Error);
  try {
    repair({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}});
    FAIL() << "a mesh without area was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "test soup");
  }
}

TEST(RepairMesh, RefusesNonFiniteCoordinatesAndIndicesOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(repair({{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}}), Error);
  EXPECT_THROW(repair({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}), Error);
  EXPECT_THROW(repair(test::soupOf(unitCube()), -0.1), Error);
  EXPECT_THROW(repair(test::soupOf(unitCube()), nan), Error);
}

}  // namespace
}  // namespace concave_distance::repair_mesh_test
