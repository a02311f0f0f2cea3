#include "mesh/trees/bounding_volume_hierarchy.h"

#include <gtest/gtest.h>

#include <set>

#include "support/body_pairs.h"
#include "support/count_allocations.h"

namespace concave_distance::bounding_volume_hierarchy_test {
namespace {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;
using Slot = Hierarchy::Slot;

std::vector<SurfaceMesh> shapes() {
  std::vector<SurfaceMesh> all;
  for (std::uint32_t k = 0; k < 6; ++k) all.push_back(test::concaveShape(k));
  all.push_back(makeSphere(0.5, 1e-3));
  all.push_back(test::makeSheet(30, 30, 0.1));  // flat
  all.push_back(test::makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  all.push_back(test::makeSurface({{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}, {{0, 1, 2}}));  // a point
  all.push_back(test::makeSurface({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {{0, 1, 2}}));  // a segment
  return all;
}

/// The triangles below a slot, through the leaves.
void collect(const Hierarchy& hierarchy, Slot slot, std::vector<TriangleIndex>& triangles) {
  const std::uint32_t child = hierarchy.child(slot);
  if ((child & Hierarchy::kLeafFlag) != 0) {
    const Hierarchy::Leaf& leaf = hierarchy.leaves()[child & ~Hierarchy::kLeafFlag];
    triangles.insert(triangles.end(), leaf.triangle, leaf.triangle + leaf.count);
    return;
  }
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (hierarchy.nodes()[child].child[lane] == Hierarchy::kNoChild) continue;
    collect(hierarchy, child * static_cast<std::uint32_t>(Hierarchy::kWidth) + lane, triangles);
  }
}

template <typename Visit>
void forEachSlot(const Hierarchy& hierarchy, Visit visit) {
  for (std::uint32_t node = 0; node < hierarchy.nodes().size(); ++node) {
    for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      if (hierarchy.nodes()[node].child[lane] == Hierarchy::kNoChild) continue;
      visit(node * static_cast<std::uint32_t>(Hierarchy::kWidth) + lane);
    }
  }
}

TEST(BoundingVolumeHierarchy, HoldsEveryTriangleOnce) {
  for (const SurfaceMesh& surface : shapes()) {
    const Hierarchy hierarchy(surface, TriangleTree(surface));
    std::vector<TriangleIndex> triangles;
    collect(hierarchy, Hierarchy::kRoot, triangles);
    EXPECT_EQ(triangles.size(), surface.triangleCount());
    EXPECT_EQ(std::set<TriangleIndex>(triangles.begin(), triangles.end()).size(), surface.triangleCount());
  }
}

TEST(BoundingVolumeHierarchy, BoxesHoldTheirTrianglesWithRoomForRounding) {
  // In long double, so that the test's own rounding is far below the margin.
  using Vector = Eigen::Matrix<long double, 3, 1>;
  for (const SurfaceMesh& surface : shapes()) {
    const Hierarchy hierarchy(surface, TriangleTree(surface));
    forEachSlot(hierarchy, [&](Slot slot) {
      const OrientedBox box = hierarchy.box(slot);
      std::vector<TriangleIndex> triangles;
      collect(hierarchy, slot, triangles);
      for (const TriangleIndex t : triangles) {
        for (int k = 0; k < 3; ++k) {
          const Vector from_centre =
              (surface.corner(t, k) - hierarchy.origin() - box.centre).cast<long double>();
          for (int axis = 0; axis < 3; ++axis) {
            const long double along = from_centre.dot(box.axes.col(axis).cast<long double>());
            const long double margin = 0.5L * Hierarchy::kBoxMargin * hierarchy.reach();
            EXPECT_LE(std::abs(along), box.half[axis] - margin);
          }
        }
      }
    });
  }
}

TEST(BoundingVolumeHierarchy, AxesAreOrthonormal) {
  for (const SurfaceMesh& surface : shapes()) {
    const Hierarchy hierarchy(surface, TriangleTree(surface));
    forEachSlot(hierarchy, [&](Slot slot) {
      const Eigen::Matrix3d axes = hierarchy.box(slot).axes;
      EXPECT_LE((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0x1.0p-50);
    });
  }
}

TEST(BoundingVolumeHierarchy, BoxesOfFlatPiecesAreFlat) {
  SurfaceMesh sheet = test::makeSheet(20, 20, 0.1);
  std::vector<Vector3d> vertices = sheet.vertices();
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (Vector3d& vertex : vertices) vertex = turned * vertex;
  const SurfaceMesh surface(vertices, sheet.triangles(), "sheet");
  const Hierarchy hierarchy(surface, TriangleTree(surface));
  forEachSlot(hierarchy, [&](Slot slot) {
    EXPECT_LE(hierarchy.box(slot).half.minCoeff(), 2.0 * Hierarchy::kBoxMargin * hierarchy.reach());
  });
}

TEST(BoundingVolumeHierarchy, StaysSmall) {
  const SurfaceMesh surface = makeSphere(0.5, 2e-5);
  const TriangleTree tree(surface);
  const std::size_t before = allocated_bytes;
  const Hierarchy hierarchy(surface, tree);
  EXPECT_LE(static_cast<double>(allocated_bytes - before),
            220.0 * static_cast<double>(surface.triangleCount()));
}

}  // namespace
}  // namespace concave_distance::bounding_volume_hierarchy_test
