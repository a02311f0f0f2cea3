#include "mesh/trees/hull_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random_engine.h"
#include "fuzz/niche_shapes.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"
#include "support/random_solids.h"

namespace concave_distance::test::hull_gap_test {
namespace {

using Eigen::Vector3d;
using WideVector = Eigen::Matrix<long double, 3, 1>;

HullGap gapOf(const SurfaceMesh& mesh) {
  return measureHullGap(mesh, buildMeshTopology(mesh), TriangleTree(mesh));
}

struct WidePlane {
  WideVector normal;
  long double most;
};

/// The planes of the convex hull: of all that go through three vertices, those with no vertex above them.
std::vector<WidePlane> hullPlanes(const SurfaceMesh& mesh) {
  std::vector<WidePlane> planes;
  const std::vector<Vector3d>& v = mesh.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = i + 1; j < v.size(); ++j) {
      for (std::size_t k = j + 1; k < v.size(); ++k) {
        const WideVector p = v[i].cast<long double>();
        WideVector normal = (v[j].cast<long double>() - p).cross(v[k].cast<long double>() - p);
        if (!(normal.norm() > 1e-12L)) continue;
        normal.normalize();
        long double above = 0.0L;
        long double below = 0.0L;
        for (const Vector3d& x : v) {
          const long double height = normal.dot(x.cast<long double>() - p);
          above = std::max(above, height);
          below = std::min(below, height);
        }
        if (above <= 1e-17L) planes.push_back({normal, normal.dot(p)});
        if (below >= -1e-17L) planes.push_back({-normal, -normal.dot(p)});
      }
    }
  }
  return planes;
}

/// How deep points on a lattice of each triangle lie below the nearest plane of the hull, at most.
long double deepestBelowHull(const SurfaceMesh& mesh) {
  const std::vector<WidePlane> planes = hullPlanes(mesh);
  long double most = 0.0L;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; i + j <= 8; ++j) {
        const WideVector point = (mesh.corner(triangle, 0).cast<long double>() * i +
                                  mesh.corner(triangle, 1).cast<long double>() * j +
                                  mesh.corner(triangle, 2).cast<long double>() * (8 - i - j)) /
                                 8.0L;
        long double depth = std::numeric_limits<long double>::infinity();
        for (const WidePlane& plane : planes) depth = std::min(depth, plane.most - plane.normal.dot(point));
        most = std::max(most, depth);
      }
    }
  }
  return most;
}

TEST(HullGap, IsNoneButRoundingForConvexSolids) {
  RandomEngine engine(1);
  for (int run = 0; run < 20; ++run) {
    const Vector3d sizes(uniformIn(engine, 0.02, 1.0), uniformIn(engine, 0.02, 1.0),
                         uniformIn(engine, 0.02, 1.0));
    const SurfaceMesh box = halvedEdges(makeCuboid(-sizes, sizes));
    EXPECT_LE(gapOf(box).gap, 1e-13 * box.diameter());
    const Eigen::Matrix3d turn = randomRotation(engine);
    const SurfaceMesh turned =
        withVertices(box, "turned", [&](const Vector3d& v) { return Vector3d(turn * v + sizes); });
    EXPECT_LE(gapOf(turned).gap, 3e-13 * turned.diameter());
  }
}

TEST(HullGap, IsNoLessThanAnyPointsDepthBelowTheHull) {
  RandomEngine engine(2);
  int measured = 0;
  for (int run = 0; run < 60; ++run) {
    const SurfaceMesh mesh = nearlyConvexShape(engine);
    const double gap = gapOf(mesh).gap;
    if (!std::isfinite(gap)) continue;
    ++measured;
    // The way along a ray is no shorter than the way to the nearest plane of the hull.
    EXPECT_GE(static_cast<long double>(gap), deepestBelowHull(mesh)) << "run " << run;
  }
  EXPECT_GE(measured, 20);
}

TEST(HullGap, IsThatOfADent) {
  for (const double depth : {1e-12, 1e-6, 1e-2}) {
    const SurfaceMesh cube = halvedEdges(makeCuboid({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
    const SurfaceMesh dented = withVertices(cube, "dented", [&](const Vector3d& v) {
      return v.x() == 0.0 && v.y() == 0.0 && v.z() > 0.0 ? Vector3d(0.0, 0.0, 0.5 - depth) : v;
    });
    const double gap = gapOf(dented).gap;
    EXPECT_GE(gap, depth * (1.0 - 1e-9) - 1e-16);
    EXPECT_LE(gap, 4.0 * depth + 1e-13);
  }
}

TEST(HullGap, TellsWhatIsBehindFromWhatSupportsTheHull) {
  for (const double depth : {1e-7, 1e-5, 1e-3, 2e-2}) {
    const SurfaceMesh mesh = makeDentedEllipsoid({0.4, 0.3, 0.5}, 2e-3, depth, 97);
    const HullGap measured = gapOf(mesh);
    ASSERT_EQ(measured.behind.size(), mesh.triangleCount()) << depth;
    std::size_t behind = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const WideVector p = mesh.corner(TriangleIndex{t}, 0).cast<long double>();
      const WideVector normal = (mesh.corner(TriangleIndex{t}, 1).cast<long double>() - p)
                                    .cross(mesh.corner(TriangleIndex{t}, 2).cast<long double>() - p)
                                    .normalized();
      long double over = 0.0L;
      for (const Vector3d& v : mesh.vertices()) over = std::max(over, normal.dot(v.cast<long double>() - p));
      if (std::abs(static_cast<double>(over) - measured.shallow) < 1e-9) continue;
      EXPECT_EQ(measured.behind[t], static_cast<double>(over) > measured.shallow) << depth << ' ' << t;
      behind += measured.behind[t] ? 1 : 0;
    }
    EXPECT_EQ(behind > 0, depth > 1e-4) << depth << ": the ball bulges by more than the shallow pits";
    EXPECT_LT(behind, mesh.triangleCount() / 4);
    for (const HullGap::Dent& dent : measured.dents) EXPECT_LE(dent.gap, measured.gap);
    EXPECT_EQ(measured.dents.empty(), behind == 0) << depth;
  }
  EXPECT_TRUE(gapOf(makeDentedEllipsoid({0.4, 0.3, 0.5}, 2e-3, 1e-2, 4)).behind.empty())
      << "more dents than hull";
}

TEST(HullGap, IsInfiniteForWhatIsNotNearlyConvex) {
  const SurfaceMesh cube = makeCuboid({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  EXPECT_TRUE(std::isinf(gapOf(makeOpened(cube, 1)).gap)) << "open";
  EXPECT_TRUE(std::isinf(gapOf(makeTurned(cube)).gap)) << "inside out";
  EXPECT_TRUE(std::isinf(gapOf(makeLShape()).gap)) << "an L";
  EXPECT_TRUE(std::isinf(gapOf(makeRing(1.0, 0.2, 12, 8)).gap)) << "a ring";
  EXPECT_TRUE(std::isinf(gapOf(makeComb(3)).gap)) << "a comb";
  EXPECT_TRUE(std::isinf(gapOf(makeSheet(3, 3)).gap)) << "a sheet";
  const SurfaceMesh other = withVertices(cube, "other", [](const Vector3d& v) { return Vector3d(0.5 * v); });
  EXPECT_TRUE(std::isinf(gapOf(makeJoined(cube, other)).gap)) << "a solid in a solid";
  EXPECT_TRUE(std::isinf(gapOf(makeJoined(cube, makeTurned(other))).gap)) << "a hollow solid";
  const SurfaceMesh beside =
      withVertices(cube, "beside", [](const Vector3d& v) { return Vector3d(v + 2.0 * Vector3d::UnitX()); });
  EXPECT_TRUE(std::isinf(gapOf(makeJoined(cube, beside)).gap)) << "two solids";
}

}  // namespace
}  // namespace concave_distance::test::hull_gap_test
