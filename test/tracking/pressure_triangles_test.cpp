// The triangles that pressure is drawn with, against closed forms of depth and area.
#include "contact/pressure_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "effect_scene.h"
#include "support/concave_shapes.h"

namespace concave_distance::pressure_triangles_test {
namespace {

using test::at;
using test::body;
using test::EffectScene;

constexpr double kFoundation = 1e9;  // Pa/m
constexpr std::size_t kMany = 100'000;

EffectSettings foundation() {
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::ElasticFoundation;
  settings.normal_force->foundation_stiffness = kFoundation;
  return settings;
}

class PressureTriangles : public ::testing::Test {
 protected:
  void press(SurfaceMesh a, SurfaceMesh b, const Eigen::Isometry3d& pose, const RelativeTwist& twist = {}) {
    a_ = body("a", std::move(a));
    b_ = body("b", std::move(b));
    scene_.emplace(a_, b_, foundation());
    scene_->update(pose, 0.01, twist);
    ASSERT_EQ(scene_->contacts.regions.size(), 1U);
    ASSERT_NE(scene_->effects.pressure(0), nullptr);
  }
  std::vector<PressureTriangle> cut(bool of_b, double lift = 0.0, std::size_t most = kMany) const {
    const InterferenceRegion& region = scene_->contacts.regions[0].overlap;
    const OverlapFacet* first = scene_->effects.surfaces().facets.data() + region.first_facet;
    const Eigen::Isometry3d& pose = scene_->solution.a_from_b;
    return pressureTriangles(
        {first, first + region.facet_count, of_b, of_b ? *a_ : *b_,
         of_b ? Eigen::Isometry3d::Identity() : pose.inverse(Eigen::Isometry), *scene_->effects.pressure(0)},
        lift, most);
  }

  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  std::optional<EffectScene> scene_;
};

/// Where the pressure of corner `k` is that of.
Eigen::Vector3d placeOf(const PressureTriangle& t, std::size_t k) {
  const Eigen::Vector3d middle = (t[0].point_in_a + t[1].point_in_a + t[2].point_in_a) / 3.0;
  return 0.9 * t[k].point_in_a + 0.1 * middle;
}

double areaOf(const std::vector<PressureTriangle>& triangles) {
  double area = 0.0;
  for (const PressureTriangle& t : triangles) {
    area += 0.5 * (t[1].point_in_a - t[0].point_in_a).cross(t[2].point_in_a - t[0].point_in_a).norm();
  }
  return area;
}

double longestEdge(const std::vector<PressureTriangle>& triangles) {
  double longest = 0.0;
  for (const PressureTriangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (t[k].point_in_a - t[(k + 1) % 3].point_in_a).norm());
    }
  }
  return longest;
}

TEST_F(PressureTriangles, OfABoxOnAPlateHaveTheDepthBelowItsNearestFace) {
  const double depth = 1e-3;
  press(makeBox({1, 1, 0.2}), makeBox({0.1, 0.1, 0.1}), at(0.02, 0.0, 0.15 - depth));
  const std::vector<PressureTriangle> triangles = cut(false);
  EXPECT_NEAR(areaOf(triangles), 0.01, 1e-12);
  EXPECT_GT(triangles.size(), 500U);
  EXPECT_LT(triangles.size(), 4000U);
  EXPECT_LT(longestEdge(triangles), 0.01) << "a gradient can be seen on two large triangles, too";
  double largest = 0.0;
  for (const PressureTriangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = placeOf(triangle, k);
      EXPECT_NEAR(p.z(), 0.1, 1e-12);
      const double border = std::min(0.05 - std::abs(p.x() - 0.02), 0.05 - std::abs(p.y()));
      EXPECT_NEAR(triangle[k].pressure, kFoundation * std::min(depth, border), 1e-3);
      largest = std::max(largest, triangle[k].pressure);
    }
  }
  EXPECT_NEAR(largest, scene_->contacts.regions[0].largest_pressure, 1e-3);
}

TEST_F(PressureTriangles, OfABallHaveTheDepthBelowThePlate) {
  press(makeBox({1, 1, 0.2}), makeSphere(0.1, 1e-5), at(0.0, 0.0, 0.19));
  for (const PressureTriangle& triangle : cut(true)) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(triangle[k].pressure, kFoundation * (0.1 - placeOf(triangle, k).z()), 1e-3);
    }
  }
}

TEST_F(PressureTriangles, AreLiftedOutOfTheirBody) {
  press(makeBox({1, 1, 0.2}), makeBox({0.1, 0.1, 0.1}), at(0.0, 0.0, 0.149));
  for (const PressureTriangle& triangle : cut(false, 1e-4)) {
    for (const PressurePoint& corner : triangle) EXPECT_NEAR(corner.point_in_a.z(), 0.1001, 1e-12);
  }
}

TEST_F(PressureTriangles, CountTheDampingOfABodyThatComesCloser) {
  RelativeTwist falling;
  falling.linear.z() = -2.0;
  press(makeBox({1, 1, 0.2}), makeBox({0.1, 0.1, 0.1}), at(0.0, 0.0, 0.149), falling);
  const double factor = 1.0 + 1.5 * Material().dissipation * 2.0;
  double largest = 0.0;
  for (const PressureTriangle& triangle : cut(false)) {
    for (const PressurePoint& corner : triangle) largest = std::max(largest, corner.pressure);
  }
  EXPECT_NEAR(largest, kFoundation * 1e-3 * factor, 1.0);
}

// The part of the plate's triangle inside the L is not convex: its fan has negative triangles.
TEST_F(PressureTriangles, StayWithinAPartThatIsNotConvex) {
  const double arm = 0.6;
  const double thickness = 0.15;
  press(makeBox({4, 4, 0.2}), test::makeLShape(arm, thickness, 0.2), at(-1.5, 0.5, 0.199));
  const std::vector<PressureTriangle> triangles = cut(false);
  const double edge = longestEdge(triangles);
  const double area = thickness * (2.0 * arm - thickness);
  EXPECT_NEAR(areaOf(triangles), area, 0.5 * edge * 4.0 * arm) << "but for the triangles at its border";
  for (const PressureTriangle& t : triangles) {
    const Eigen::Vector3d centre = (t[0].point_in_a + t[1].point_in_a + t[2].point_in_a) / 3.0;
    const double x = centre.x() + 1.5;
    const double y = centre.y() - 0.5;
    EXPECT_TRUE(x > 0.0 && y > 0.0 && x < arm && y < arm && (x < thickness || y < thickness));
  }
}

TEST_F(PressureTriangles, AreNeverMoreThanAllowed) {
  press(makeBox({1, 1, 0.2}), makeSphere(0.1, 1e-4), at(0.0, 0.0, 0.19));
  const std::size_t all = cut(true).size();
  for (const std::size_t most : {all, all / 2, all / 4}) EXPECT_LE(cut(true, 0.0, most).size(), most);
  EXPECT_TRUE(cut(true, 0.0, 3).empty()) << "the ball has more facets in the plate";
  EXPECT_FALSE(cut(false, 0.0, kMany).empty());
}

TEST_F(PressureTriangles, AreNoneOfALumpedForceAndAfterParting) {
  EffectScene lumped(body("a", makeBox({1, 1, 0.2})), body("b", makeBox({0.1, 0.1, 0.1})), test::spring(1e6));
  lumped.update(at(0.0, 0.0, 0.149));
  EXPECT_EQ(lumped.effects.pressure(0), nullptr);
  press(makeBox({1, 1, 0.2}), makeBox({0.1, 0.1, 0.1}), at(0.0, 0.0, 0.149));
  EXPECT_EQ(scene_->effects.pressure(1), nullptr);
  scene_->update(at(0.0, 0.0, 0.2));
  EXPECT_EQ(scene_->effects.pressure(0), nullptr);
  scene_->update(at(0.0, 0.0, 0.149));
  EXPECT_NE(scene_->effects.pressure(0), nullptr);
  scene_->effects.setSettings(test::spring(1e6), inContact(Material(), Material()));
  EXPECT_EQ(scene_->effects.pressure(0), nullptr);
}

// A round solid shows the other body's surface alone, lifted out of the solid so that it is seen.
TEST_F(PressureTriangles, OfAnExactBallTheyLieOnItWithTheDepthsPressure) {
  const double radius = 0.1;
  const double depth = 1e-3;
  const double lift = 1e-4;
  a_ = body("plate", makeBox({1, 1, 0.2}));
  RoundShape ball;
  ball.radius = radius;
  ball.chord_error = 0.005;  // more than the depth: what is exact is seen in the pressures
  BodyMeshOptions options;
  options.shape = ball;
  b_ = std::make_shared<BodyMesh>("ball", inscribedMesh(ball, "ball"), options);
  scene_.emplace(a_, b_, foundation());
  const Eigen::Vector3d centre(0.03, 0.01, 0.1 + radius - depth);
  scene_->update(at(centre.x(), centre.y(), centre.z()));
  EXPECT_TRUE(cut(true).empty());
  const std::vector<PressureTriangle> triangles = cut(false, -lift);
  ASSERT_GT(triangles.size(), 100U);
  double largest = 0.0;
  for (const PressureTriangle& triangle : triangles) {
    for (const PressurePoint& corner : triangle) {
      largest = std::max(largest, corner.pressure);
      EXPECT_LT(corner.point_in_a.z(), 0.1 - 0.99 * lift);
      EXPECT_LT(corner.pressure, 1.0001 * kFoundation * depth);
    }
    const Eigen::Vector3d normal = (triangle[1].point_in_a - triangle[0].point_in_a)
                                       .cross(triangle[2].point_in_a - triangle[0].point_in_a);
    EXPECT_LE(normal.z(), 0.0);
  }
  EXPECT_GT(largest, 0.98 * kFoundation * depth);
}

}  // namespace
}  // namespace concave_distance::pressure_triangles_test
