#include "distance/niches/niche_properties.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::niche_properties_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::makeCuboid;

using Body = std::shared_ptr<const BodyMesh>;

TriangleIndex randomTriangleOf(const Body& body, RandomEngine& engine) {
  return TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(body->surface().triangleCount()))};
}

TriangleIndex carrierOf(const Body& body, const Vector3d& point) {
  TriangleIndex nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < body->surface().triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const double squared_distance = pointTriangleDistance(point, {body->surface().corner(triangle, 0),
                                                                  body->surface().corner(triangle, 1),
                                                                  body->surface().corner(triangle, 2)})
                                        .squared_distance;
    if (squared_distance < least) {
      least = squared_distance;
      nearest = triangle;
    }
  }
  return nearest;
}

bool isInside(const Body& body, const Vector3d& point) {
  return containsPoint(body->tree(), body->surface(), body->topology().shell_is_closed,
                       body->topology().shell_of_triangle, point);
}

TEST(ClassifyOutwardness, AgreesWithInsideAndOutsideAtEveryLocalMinimum) {
  RandomEngine engine(1);
  RefinementWorkspace workspace;
  std::map<Outwardness, int> counts;
  for (std::uint32_t round = 0; round < 120; ++round) {
    const Body a = makeBody(test::concaveShape(round % 4));
    const Body b = makeBody(test::concaveShape(round % 3));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    const Isometry3d back = pose.inverse(Eigen::Isometry);
    for (int start = 0; start < 40; ++start) {
      const WitnessPair witness =
          refineWitness(*a, *b, pose, randomTriangleOf(a, engine), randomTriangleOf(b, engine), workspace)
              .witness;
      const double d = std::sqrt(witness.squared_distance);
      if (d < 1e-3) continue;
      const Vector3d step = 1e-6 / d * (witness.point_b_in_a - witness.point_a_in_a);
      const bool leaves_outwards =
          !isInside(a, witness.point_a_in_a + step) && !isInside(b, back * (witness.point_b_in_a - step));
      const Outwardness found = classifyOutwardness(*a, *b, pose, witness);
      EXPECT_EQ(found, leaves_outwards ? Outwardness::Outward : Outwardness::ThroughMaterial);
      ++counts[found];
    }
  }
  EXPECT_GT(counts[Outwardness::Outward], 200);
  EXPECT_GT(counts[Outwardness::ThroughMaterial], 50);
}

TEST(ClassifyOutwardness, FlagsTheBackOfAnOpenSheetOnly) {
  const SurfaceMesh sheet = test::makeSheet(2, 2, 0.5);  // normals along +z
  const Body ball = makeBody(makeSphere(0.2, 0.01));
  for (const double height : {0.5, -0.5}) {
    const Isometry3d pose = test::translation(Vector3d(0.4, 0.3, height));
    const Body a = makeBody(sheet);
    const Body turned = makeBody(test::makeTurned(sheet));
    const Outwardness front = Outwardness::Outward;
    const Outwardness back = Outwardness::Unknown;
    const WitnessPair witness = test::enumerateTrianglePairs(*a, *ball, pose);
    EXPECT_EQ(classifyOutwardness(*a, *ball, pose, witness), height > 0.0 ? front : back);
    const WitnessPair other = test::enumerateTrianglePairs(*turned, *ball, pose);
    EXPECT_EQ(classifyOutwardness(*turned, *ball, pose, other), height > 0.0 ? back : front);
  }
  // Beside the sheet, in its plane, neither side is the back.
  const Body a = makeBody(sheet);
  const Isometry3d beside = test::translation(Vector3d(1.5, 0.4, 0.0));
  EXPECT_EQ(classifyOutwardness(*a, *ball, beside, test::enumerateTrianglePairs(*a, *ball, beside)),
            Outwardness::Outward);
}

TEST(ClassifyOutwardness, AClosedShellOutweighsAnOpenOne) {
  // A sheet under the floor of a closed box, seen through the box's wall from the inside out.
  const Body a = makeBody(test::makeTurned(test::makeSheet(2, 2, 0.5)));  // normals along -z
  const Body b = makeBody(makeCuboid(Vector3d(0, 0, 0), Vector3d(0.9, 0.9, 0.5)));
  const Isometry3d pose = test::translation(Vector3d(0.05, 0.05, 0.2));
  // b's top, 0.7 above the sheet, its floor in between: a local minimum on two parallel faces.
  WitnessPair witness;
  witness.point_a_in_a = Vector3d(0.4375, 0.3125, 0.0);
  witness.point_b_in_a = Vector3d(0.4375, 0.3125, 0.7);
  witness.squared_distance = 0.49;
  witness.triangle_a = carrierOf(a, witness.point_a_in_a);
  witness.triangle_b = carrierOf(b, pose.inverse(Eigen::Isometry) * witness.point_b_in_a);
  EXPECT_EQ(classifyOutwardness(*a, *b, pose, witness), Outwardness::ThroughMaterial);
  EXPECT_FALSE(isVisible(*a, *b, pose, witness));
  // Without the box's winding to tell, only the sheet's back is known of.
  const Body open = makeBody(test::makeOpened(test::makeTurned(b->surface()), 0));
  witness.triangle_b = carrierOf(open, pose.inverse(Eigen::Isometry) * witness.point_b_in_a);
  EXPECT_EQ(classifyOutwardness(*a, *open, pose, witness), Outwardness::Unknown);
}

TEST(ClassifyOutwardness, SeesEdgesWhereManyTrianglesMeet) {
  // Two boxes that share an edge, one mesh: its four triangles' normals cancel in part.
  const SurfaceMesh joined = test::makeJoined(makeCuboid(Vector3d(0, 0, 0), Vector3d(1, 1, 1)),
                                              makeCuboid(Vector3d(1, 1, 0), Vector3d(2, 2, 1)));
  std::vector<TriangleNodes> triangles = joined.triangles();
  for (TriangleNodes& t : triangles) {
    for (NodeIndex& node : t) {
      if (node.value == 8) node = NodeIndex{3};
      if (node.value == 12) node = NodeIndex{7};
    }
  }
  const Body a = makeBody(SurfaceMesh(joined.vertices(), triangles, "two boxes"));
  const Body ball = makeBody(makeSphere(0.1, 0.005));
  RandomEngine engine(3);
  for (int i = 0; i < 200; ++i) {
    Isometry3d pose = test::randomPose(engine, 1.5);
    pose.translation() += Vector3d(1, 1, 0.5);
    const WitnessPair witness = test::enumerateTrianglePairs(*a, *ball, pose);
    if (witness.squared_distance == 0.0 || isInside(a, pose.translation())) continue;
    EXPECT_EQ(classifyOutwardness(*a, *ball, pose, witness), Outwardness::Outward);
  }
}

TEST(ClassifyOutwardness, TouchingWitnessesAreOutward) {
  const Body a = makeBody(makeCuboid(Vector3d::Zero(), Vector3d::Ones()));
  const Isometry3d pose = test::translation(Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(classifyOutwardness(*a, *a, pose, test::enumerateTrianglePairs(*a, *a, pose)),
            Outwardness::Outward);
}

/// Every triangle of either body against the segment, ends cut off, through the distance kernel.
bool isFreeByBruteForce(const Body& body, const Isometry3d& a_from_body, const WitnessPair& witness) {
  const Vector3d cut = 1e-9 * (witness.point_b_in_a - witness.point_a_in_a);
  const Isometry3d back = a_from_body.inverse(Eigen::Isometry);
  const Vector3d from = back * (witness.point_a_in_a + cut);
  const Vector3d to = back * (witness.point_b_in_a - cut);
  for (std::uint32_t t = 0; t < body->surface().triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const TrianglePoints corners = {body->surface().corner(triangle, 0), body->surface().corner(triangle, 1),
                                    body->surface().corner(triangle, 2)};
    if (triangleDistance({from, to, to}, corners).squared_distance == 0.0) return false;
  }
  return true;
}

TEST(IsVisible, AgreesWithBruteForceAtEveryLocalMinimum) {
  RandomEngine engine(2);
  RefinementWorkspace workspace;
  int visible = 0;
  int hidden = 0;
  for (std::uint32_t round = 0; round < 120; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round / 4));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    for (int start = 0; start < 40; ++start) {
      const WitnessPair witness =
          refineWitness(*a, *b, pose, randomTriangleOf(a, engine), randomTriangleOf(b, engine), workspace)
              .witness;
      if (witness.squared_distance < 1e-6) continue;
      const bool expected =
          isFreeByBruteForce(a, Isometry3d::Identity(), witness) && isFreeByBruteForce(b, pose, witness);
      EXPECT_EQ(isVisible(*a, *b, pose, witness), expected);
      ++(expected ? visible : hidden);
    }
  }
  EXPECT_GT(visible, 200);
  EXPECT_GT(hidden, 50);
}

TEST(IsVisible, TheClosestPairAlwaysIs) {
  RandomEngine engine(4);
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round / 6));
    const Isometry3d pose = test::randomPose(engine, 2.0);
    EXPECT_TRUE(isVisible(*a, *b, pose, test::enumerateTrianglePairs(*a, *b, pose)));
  }
}

}  // namespace
}  // namespace concave_distance::niche_properties_test
