#include "mesh/trees/normal_cone_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "distance/kernels/triangle_distance.h"
#include "support/body_pairs.h"

namespace concave_distance::normal_cone_tree_test {
namespace {

using Eigen::Vector3d;

/// The closest point of the whole surface to a target, by looking at every triangle.
Vector3d closestByForce(const SurfaceMesh& mesh, const Vector3d& target) {
  double least = std::numeric_limits<double>::infinity();
  Vector3d closest = target;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const PointTriangleDistance d = pointTriangleDistance(
        target, {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)});
    if (d.squared_distance < least) {
      least = d.squared_distance;
      closest = d.point;
    }
  }
  return closest;
}

bool holds(const DirectionCap& cap, const Vector3d& direction) {
  return cap.isFull() || cap.axis.dot(direction) >= cap.cosine - 1e-12;
}

/// Whether a walk from the root over children that hold the point and the direction ends at an item that
/// does. Children are kept in single precision.
bool leadsTo(const NormalConeTree& tree, const Vector3d& point, const Vector3d& direction, double slack) {
  const Vector3d in_units = (point - tree.origin()) / tree.unit();
  std::vector<NormalConeTree::Slot> open{NormalConeTree::kRoot};
  while (!open.empty()) {
    const NormalConeTree::Slot slot = open.back();
    open.pop_back();
    const NormalConeTree::Group& group = tree.groups()[slot];
    const Vector3d centre(group.centre[0], group.centre[1], group.centre[2]);
    const Vector3d axis(group.axis[0], group.axis[1], group.axis[2]);
    if ((in_units - centre).norm() > group.radius + slack / tree.unit()) continue;
    if (group.angle < 3.1415F && axis.dot(direction) < std::cos(group.angle) - 1e-7) continue;
    const std::uint32_t child = group.child;
    if ((child & NormalConeTree::kItemFlag) != 0) {
      const NormalConeTree::Item& item = tree.items()[child & ~NormalConeTree::kItemFlag];
      if ((point - item.centre).norm() <= item.radius + slack && holds(item.cap, direction)) return true;
      continue;
    }
    for (std::uint32_t part = child; part < child + NormalConeTree::kWidth; ++part) {
      if (tree.child(part) == NormalConeTree::kNoChild) break;
      open.push_back(part);
    }
  }
  return false;
}

TEST(NormalConeTree, LeadsToEveryClosestPointFromEveryTarget) {
  RandomEngine engine(2);
  for (std::uint32_t shape = 0; shape < 6; ++shape) {
    const SurfaceMesh mesh = test::concaveShape(shape);
    const MeshTopology topology = buildMeshTopology(mesh);
    const NormalConeTree both(mesh, topology, NormalSides::Both);
    const NormalConeTree outside(mesh, topology, NormalSides::Outside);
    EXPECT_LE(outside.items().size(), both.items().size());
    for (int k = 0; k < 500; ++k) {
      const Vector3d target = mesh.boundingBox().center() + test::uniformInCube(engine, mesh.diameter());
      const Vector3d closest = closestByForce(mesh, target);
      const double distance = (target - closest).norm();
      if (!(distance > 1e-6)) continue;
      const Vector3d direction = (target - closest) / distance;
      const double slack = 1e-12 * mesh.diameter();
      EXPECT_TRUE(leadsTo(both, closest, direction, slack)) << shape;
      // A box's diagonal away from the centre is outside.
      if ((target - mesh.boundingBox().center()).norm() > 0.5 * mesh.diameter()) {
        EXPECT_TRUE(leadsTo(outside, closest, direction, slack)) << shape;
      }
    }
  }
}

// The cone of the tip has as many corners as there are triangles: not all of them are kept.
TEST(NormalConeTree, LeadsToATipOfManyTriangles) {
  const SurfaceMesh mesh = test::makeFan(3000);
  const NormalConeTree tree(mesh, buildMeshTopology(mesh), NormalSides::Both);
  RandomEngine engine(4);
  for (int k = 0; k < 100; ++k) {
    const Vector3d target(test::uniformIn(engine, -2, 2), test::uniformIn(engine, -2, 2), 4.0);
    const Vector3d closest = closestByForce(mesh, target);
    EXPECT_TRUE(leadsTo(tree, closest, (target - closest).normalized(), 1e-12));
  }
}

TEST(NormalConeTree, OfAFanOfManyTrianglesIsMadeInLinearTime) {
  const SurfaceMesh mesh = test::makeFan(100'000);
  const NormalConeTree tree(mesh, buildMeshTopology(mesh), NormalSides::Both);
  EXPECT_GT(tree.items().size(), 250'000U);
}

TEST(NormalConeTree, OfABoxHasNoReflexFeatureOutsideAndNoConvexOneInside) {
  const SurfaceMesh box = test::makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  const MeshTopology topology = buildMeshTopology(box);
  const NormalConeTree outside(box, topology, NormalSides::Outside);
  std::size_t sharp_edges = 0;
  for (const NormalConeTree::Item& item : outside.items()) {
    ASSERT_FALSE(item.cap.isFull());
    EXPECT_NEAR(item.cap.cosine * item.cap.cosine + item.cap.sine * item.cap.sine, 1.0, 1e-12);
    const double angle = std::atan2(item.cap.sine, item.cap.cosine);
    if (item.kind == NormalConeTree::Kind::Face) {
      EXPECT_LT(angle, 1e-8);
    } else if (item.kind == NormalConeTree::Kind::Edge && angle > 0.1) {
      EXPECT_NEAR(angle, M_PI / 4, 1e-8);
      ++sharp_edges;
    } else if (item.kind == NormalConeTree::Kind::Vertex) {
      EXPECT_GE(angle, std::acos(1.0 / std::sqrt(3.0)));
      EXPECT_LT(angle, std::acos(1.0 / std::sqrt(3.0)) + 0.05);  // the axis is near the middle
    }
  }
  EXPECT_EQ(sharp_edges, 12U);
  // Turned inside out the faces and their diagonals are all that is left.
  const SurfaceMesh turned = test::makeTurned(box);
  const NormalConeTree of_turned(turned, buildMeshTopology(turned), NormalSides::Outside);
  for (const NormalConeTree::Item& item : of_turned.items()) {
    EXPECT_NE(item.kind, NormalConeTree::Kind::Vertex);
    EXPECT_LT(std::atan2(item.cap.sine, item.cap.cosine), 1e-8);
  }
}

}  // namespace
}  // namespace concave_distance::normal_cone_tree_test
