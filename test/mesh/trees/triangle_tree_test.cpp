#include "mesh/trees/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/surface/mesh_topology.h"
#include "support/plain_shapes.h"

namespace concave_distance::triangle_tree_test {
namespace {

using Eigen::Vector3d;
using test::makeCuboid;

SurfaceMesh randomTriangles(RandomEngine& engine, std::size_t count, double size) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (std::size_t t = 0; t < count; ++t) {
    const Vector3d centre = test::uniformInCube(engine, 1.0);
    for (int k = 0; k < 3; ++k) {
      vertices.push_back(centre + test::uniformInCube(engine, size));
    }
    triangles.push_back({NodeIndex{3 * t}, NodeIndex{3 * t + 1}, NodeIndex{3 * t + 2}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "random triangles");
}

/// Every node's box holds its triangles; every triangle is in one leaf. Returns the depth.
std::size_t checkNode(const TriangleTree& tree, const SurfaceMesh& mesh, std::size_t index,
                      std::vector<int>& seen, Eigen::AlignedBox3d& inside) {
  const TriangleTree::Node& node = tree.nodes()[index];
  std::size_t depth = 1;
  if (node.count > 0) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const TriangleIndex t = tree.order()[i];
      ++seen[t.value];
      for (int k = 0; k < 3; ++k) {
        inside.extend(mesh.corner(t, k));
      }
    }
  } else {
    for (const std::size_t child : {index + 1, std::size_t{node.first}}) {
      Eigen::AlignedBox3d child_inside;
      depth = std::max(depth, 1 + checkNode(tree, mesh, child, seen, child_inside));
      inside.extend(child_inside);
    }
  }
  EXPECT_TRUE(node.box.contains(inside));
  return depth;
}

void checkTree(const SurfaceMesh& mesh, std::size_t largest_depth) {
  const TriangleTree tree(mesh);
  std::vector<int> seen(mesh.triangleCount(), 0);
  Eigen::AlignedBox3d inside;
  EXPECT_LE(checkNode(tree, mesh, 0, seen, inside), largest_depth);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(mesh.triangleCount()));
  EXPECT_LE(tree.nodes().size(), 2 * mesh.triangleCount());
}

TEST(TriangleTree, HoldsEveryTriangleOnceInBoxesThatContainIt) {
  RandomEngine engine(1);
  for (const std::size_t count : {1U, 2U, 5U, 100U, 5000U}) {
    checkTree(randomTriangles(engine, count, 0.1), 40);
  }
}

TEST(TriangleTree, StaysShallowWhereTrianglesCoincideOrShrinkGeometrically) {
  const SurfaceMesh one = test::makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const SurfaceMesh same(one.vertices(), std::vector<TriangleNodes>(3000, one.triangles()[0]), "copies");
  checkTree(same, 20);

  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  double size = 1.0;
  for (std::uint32_t t = 0; t < 900; ++t, size *= 0.5) {  // splits by area peel off one triangle at a time
    vertices.insert(vertices.end(), {Vector3d(size, 0, 0), Vector3d(size, size, 0), Vector3d(size, 0, size)});
    triangles.push_back({NodeIndex{3 * t}, NodeIndex{3 * t + 1}, NodeIndex{3 * t + 2}});
  }
  checkTree(SurfaceMesh(vertices, triangles, "geometric series"), 80);
}

TEST(TriangleTree, IsEmptyForAnEmptyMesh) {
  const TriangleTree tree{SurfaceMesh()};
  EXPECT_TRUE(tree.nodes().empty());
  EXPECT_FALSE(segmentHits(tree, SurfaceMesh(), Vector3d::Zero(), Vector3d::Ones(), 0.0));
}

/// Moeller and Trumbore's formula in long double, an independent way to the same answer.
bool crosses(const SurfaceMesh& mesh, TriangleIndex t, const Vector3d& a, const Vector3d& b, bool& doubtful) {
  using Vector3l = Eigen::Matrix<long double, 3, 1>;
  const Vector3l origin = a.cast<long double>();
  const Vector3l d = b.cast<long double>() - origin;
  const Vector3l v0 = mesh.corner(t, 0).cast<long double>();
  const Vector3l e1 = mesh.corner(t, 1).cast<long double>() - v0;
  const Vector3l e2 = mesh.corner(t, 2).cast<long double>() - v0;
  const Vector3l p = d.cross(e2);
  const long double determinant = e1.dot(p);
  const Vector3l s = origin - v0;
  const Vector3l q = s.cross(e1);
  const long double u = s.dot(p) / determinant;
  const long double v = d.dot(q) / determinant;
  const long double along = e2.dot(q) / determinant;
  constexpr long double kDoubt = 1e-10L;
  for (const long double value : {u, v, 1 - u - v, along, 1 - along}) {
    doubtful = doubtful || std::abs(value) < kDoubt;
  }
  return u >= 0 && v >= 0 && u + v <= 1 && along >= 0 && along <= 1;
}

TEST(SegmentHits, AgreesWithBruteForce) {
  RandomEngine engine(2);
  const SurfaceMesh mesh = randomTriangles(engine, 300, 0.15);
  const TriangleTree tree(mesh);
  int hits = 0;
  int doubted = 0;
  constexpr int kSegments = 2000;
  for (int i = 0; i < kSegments; ++i) {
    const Vector3d a = test::uniformInCube(engine, 1.2);
    Vector3d b = test::uniformInCube(engine, 1.2);
    if (i % 5 == 0) b.x() = a.x();  // along a plane of the boxes
    bool expected = false;
    bool doubtful = false;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      expected = crosses(mesh, TriangleIndex{t}, a, b, doubtful) || expected;
    }
    if (doubtful) {
      ++doubted;
      continue;
    }
    EXPECT_EQ(segmentHits(tree, mesh, a, b, 0.0), expected) << "segment " << i;
    hits += expected ? 1 : 0;
  }
  EXPECT_GT(hits, kSegments / 10);
  EXPECT_LT(hits, kSegments - kSegments / 10);
  EXPECT_LT(doubted, kSegments / 100);
}

TEST(SegmentHits, LeavesOutTheMarginAtBothEnds) {
  const SurfaceMesh box = makeCuboid(Vector3d::Zero(), Vector3d::Ones());
  const TriangleTree tree(box);
  const Vector3d top(0.3, 0.4, 1.0);
  const Vector3d above(0.3, 0.4, 2.0);
  EXPECT_TRUE(segmentHits(tree, box, top, above, 0.0));
  EXPECT_FALSE(segmentHits(tree, box, top, above, 1e-9));
  EXPECT_TRUE(segmentHits(tree, box, top - Vector3d(0, 0, 1e-8), above, 1e-9));
  EXPECT_FALSE(segmentHits(tree, box, top, top, 1e-9));
  EXPECT_TRUE(segmentHits(tree, box, above, Vector3d(0.3, 0.4, 0.5), 1e-9));
}

TEST(SegmentHits, SeesEdgesVerticesAndTrianglesItLiesIn) {
  const SurfaceMesh box = makeCuboid(Vector3d::Zero(), Vector3d::Ones());
  const TriangleTree tree(box);
  EXPECT_TRUE(segmentHits(tree, box, {-1, -1, 0.5}, {1, 1, 0.5}, 0.0));     // through an edge
  EXPECT_TRUE(segmentHits(tree, box, {-1, -1, -1}, {0.5, 0.5, 0.5}, 0.0));  // through a vertex
  EXPECT_TRUE(segmentHits(tree, box, {-1, 0.5, 1}, {2, 0.5, 1}, 0.0));      // in the top's plane, across it
  EXPECT_TRUE(segmentHits(tree, box, {0.2, 0.3, 1}, {0.3, 0.4, 1}, 0.0));   // in the top's plane, inside it
  EXPECT_FALSE(segmentHits(tree, box, {-1, 2, 1}, {2, 2, 1}, 0.0));         // in the top's plane, beside it
  EXPECT_FALSE(segmentHits(tree, box, {0.2, 0.3, 0.4}, {0.6, 0.5, 0.7}, 0.0));  // inside the box
}

TEST(ContainsPoint, TellsInsideFromOutsideOfABox) {
  const SurfaceMesh box = makeCuboid(Vector3d::Zero(), Vector3d::Ones());
  const TriangleTree tree(box);
  const MeshTopology topology = buildMeshTopology(box);
  RandomEngine engine(3);
  for (int i = 0; i < 5000; ++i) {
    Vector3d p = Vector3d::Constant(0.5) + test::uniformInCube(engine, 0.8);
    if (i % 2 == 0) {  // on a lattice through the diagonals, edges and corners as seen along many rays
      p = (p * 16.0).array().round() / 16.0 + 1.0 / 64.0;
    }
    const bool expected = (p.array() > 0.0).all() && (p.array() < 1.0).all();
    EXPECT_EQ(containsPoint(tree, box, topology.shell_is_closed, topology.shell_of_triangle, p), expected)
        << p.transpose();
  }
}

TEST(ContainsPoint, CountsEachRayThroughEdgesAndVerticesOnce) {
  // Points placed so that a ray of the test itself runs through a vertex, an edge midpoint or along a face.
  const SurfaceMesh box = makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  const TriangleTree tree(box);
  const MeshTopology topology = buildMeshTopology(box);
  const Vector3d direction(0.8431, 0.2749, 0.4620);
  for (const Vector3d& target :
       {Vector3d(1, 1, 1), Vector3d(1, 0, 1), Vector3d(1, 1, 0), Vector3d(1, 0, 0)}) {
    for (const double back : {0.25, 0.5, 1.0, 3.5}) {
      const Vector3d p = target - back * direction;
      const bool expected = (p.array().abs() < 1.0).all();
      EXPECT_EQ(containsPoint(tree, box, topology.shell_is_closed, topology.shell_of_triangle, p), expected);
    }
  }
}

TEST(ContainsPoint, KnowsCavitiesNestedAndOpenShells) {
  const SurfaceMesh outer = makeCuboid(Vector3d::Constant(-2), Vector3d::Constant(2));
  const SurfaceMesh inner = makeCuboid(Vector3d::Constant(-1), Vector3d::Constant(1));
  const auto contains = [](const SurfaceMesh& mesh, const Vector3d& p) {
    const MeshTopology topology = buildMeshTopology(mesh);
    return containsPoint(TriangleTree(mesh), mesh, topology.shell_is_closed, topology.shell_of_triangle, p);
  };
  const Vector3d middle(0.01, 0.02, 0.03);
  const Vector3d wall(1.5, 0.02, 0.03);
  const SurfaceMesh hollow = test::makeJoined(outer, test::makeTurned(inner));
  EXPECT_FALSE(contains(hollow, middle));
  EXPECT_TRUE(contains(hollow, wall));
  const SurfaceMesh nested = test::makeJoined(outer, inner);
  EXPECT_TRUE(contains(nested, middle));
  EXPECT_TRUE(contains(nested, wall));
  EXPECT_FALSE(contains(test::makeTurned(outer), middle));  // inside out: no solid
  const SurfaceMesh half_open = test::makeJoined(test::makeOpened(outer, 4), inner);
  EXPECT_TRUE(contains(half_open, middle));
  EXPECT_FALSE(contains(half_open, wall));
}

TEST(ContainsPoint, WindingOfAWavyShellAgreesWithItsVolume) {
  // A closed star-shaped surface: r(direction) is known, so inside is a comparison.
  constexpr std::uint32_t kRings = 24;
  constexpr std::uint32_t kSectors = 36;
  const auto radius = [](double polar, double around) {
    return 1.0 + 0.3 * std::sin(3.0 * around) * std::sin(polar) * std::sin(polar);
  };
  std::vector<Vector3d> vertices{{0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 1; i < kRings; ++i) {
    for (std::uint32_t j = 0; j < kSectors; ++j) {
      const double polar = M_PI * i / kRings;
      const double around = 2.0 * M_PI * j / kSectors;
      vertices.push_back(radius(polar, around) * Vector3d(std::sin(polar) * std::cos(around),
                                                          std::sin(polar) * std::sin(around),
                                                          std::cos(polar)));
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t sector) {
    if (ring == 0) return NodeIndex{0};
    if (ring == kRings) return NodeIndex{1};
    return NodeIndex{2 + (ring - 1) * kSectors + sector % kSectors};
  };
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < kRings; ++i) {
    for (std::uint32_t j = 0; j < kSectors; ++j) {
      if (i + 1 < kRings) triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const SurfaceMesh star(vertices, triangles, "star");
  const MeshTopology topology = buildMeshTopology(star);
  ASSERT_TRUE(topology.allShellsClosed());
  const TriangleTree tree(star);
  RandomEngine engine(4);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d p = test::uniformInCube(engine, 1.4);
    const double r = p.norm();
    const double surface = radius(std::acos(p.z() / r), std::atan2(p.y(), p.x()));
    if (std::abs(r - surface) < 0.05) continue;  // the chord error of the tessellation
    inside += r < surface ? 1 : 0;
    EXPECT_EQ(containsPoint(tree, star, topology.shell_is_closed, topology.shell_of_triangle, p),
              r < surface);
  }
  EXPECT_GT(inside, 500);
}

}  // namespace
}  // namespace concave_distance::triangle_tree_test
