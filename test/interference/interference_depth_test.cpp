#include <gtest/gtest.h>

#include <algorithm>

#include "interference/interference_checks.h"
#include "support/random_solids.h"

namespace concave_distance::interference_depth_test {
namespace {

/// Where a line along z meets a surface whose vertices have been turned there: heights and triangles.
std::vector<double> heightsOver(const SurfaceMesh& mesh, double x, double y) {
  std::vector<double> heights;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Eigen::Vector3d& p = mesh.corner(TriangleIndex{t}, 0);
    const Eigen::Vector3d u = mesh.corner(TriangleIndex{t}, 1) - p;
    const Eigen::Vector3d v = mesh.corner(TriangleIndex{t}, 2) - p;
    const double area = u.x() * v.y() - u.y() * v.x();
    if (area == 0.0) continue;
    const double s = ((x - p.x()) * v.y() - (y - p.y()) * v.x()) / area;
    const double r = (u.x() * (y - p.y()) - u.y() * (x - p.x())) / area;
    if (s >= 0.0 && r >= 0.0 && s + r <= 1.0) heights.push_back(p.z() + s * u.z() + r * v.z());
  }
  return heights;
}

SurfaceMesh turned(const SurfaceMesh& mesh, const Eigen::Isometry3d& motion) {
  std::vector<Eigen::Vector3d> vertices = mesh.vertices();
  for (Eigen::Vector3d& v : vertices) v = motion * v;
  return SurfaceMesh(std::move(vertices), mesh.triangles(), "turned");
}

/// The greatest height of A's surface in B over B's in A on one line.
double depthOnLine(const SurfaceMesh& a, const SurfaceMesh& b, double x, double y) {
  const std::vector<double> of_a = heightsOver(a, x, y);
  const std::vector<double> of_b = heightsOver(b, x, y);
  // Inside: an odd number of the other's surface above.
  const auto inside = [](double z, const std::vector<double>& others) {
    return std::count_if(others.begin(), others.end(), [&](double o) { return o > z; }) % 2 == 1;
  };
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  for (const double z : of_a) {
    if (inside(z, of_b)) top = std::max(top, z);
  }
  for (const double z : of_b) {
    if (inside(z, of_a)) bottom = std::min(bottom, z);
  }
  return top - bottom;
}

TEST(InterferenceDepth, IsAttainedAndNoLineThroughTheRegionIsDeeper) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const SurfaceMesh a = test::randomSolid(engine);
    const SurfaceMesh b = test::randomSolid(engine);
    const Eigen::Isometry3d pose = test::randomOverlappingPose(a, b, engine);
    const Interference result = test::interferenceOf(a, b, pose);
    if (result.regions.size() != 1 || result.regions[0].loop_count == 0) continue;
    const InterferenceRegion& region = result.regions[0];
    ++compared;
    EXPECT_NEAR((region.along_normal_a_in_a - region.along_normal_b_in_a -
                 region.depth_along_normal * region.normal_in_a)
                    .norm(),
                0.0, 8.0 * result.rounding_bound);
    Eigen::Isometry3d upright(
        Eigen::Quaterniond::FromTwoVectors(region.normal_in_a, Eigen::Vector3d::UnitZ()));
    upright.translation() = -(upright * region.along_normal_b_in_a);
    const SurfaceMesh a_up = turned(a, upright);
    const SurfaceMesh b_up = turned(b, upright * pose);
    const Eigen::AlignedBox3d common = a_up.boundingBox().intersection(b_up.boundingBox());
    double deepest = 0.0;
    for (int i = 0; i < 400; ++i) {
      // Half of the lines all over, half of them close by the deepest.
      const double reach = i % 2 == 0 ? 1.0 : std::pow(10.0, -2.0 - 4.0 * uniformUnit(engine));
      const double x = i % 2 == 0 ? test::uniformIn(engine, common.min().x(), common.max().x())
                                  : test::uniformIn(engine, -reach, reach);
      const double y = i % 2 == 0 ? test::uniformIn(engine, common.min().y(), common.max().y())
                                  : test::uniformIn(engine, -reach, reach);
      const double depth = depthOnLine(a_up, b_up, x, y);
      EXPECT_LE(depth, region.depth_along_normal + 1e-12) << x << " " << y;
      deepest = std::max(deepest, depth);
    }
    if (region.normal_is_fallback) continue;  // along an axis of the bodies, often attained on a rim alone
    EXPECT_GE(deepest, 0.98 * region.depth_along_normal);
  }
  EXPECT_GT(compared, 80u);
}

TEST(InterferenceDepth, IsTheTranslationThatTakesConvexBodiesApart) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto a = test::makeBody(makeBox({1, 0.8, 0.6}));
    const auto b = test::makeBody(makeSphere(0.4, 5e-3));
    Eigen::Isometry3d pose = test::randomPose(engine, 0.6);
    const Interference result = test::interferenceOf(*a, *b, pose);
    if (result.regions.empty() || result.regions[0].loop_count == 0) continue;
    const InterferenceRegion& region = result.regions[0];
    Eigen::Isometry3d moved = pose;
    moved.translation() = pose.translation() + (region.depth_along_normal + 1e-12) * region.normal_in_a;
    EXPECT_TRUE(test::interferenceOf(*a, *b, moved).regions.empty());
    moved.translation() = pose.translation() + (region.depth_along_normal - 1e-6) * region.normal_in_a;
    EXPECT_FALSE(test::interferenceOf(*a, *b, moved).regions.empty());
  }
}

}  // namespace
}  // namespace concave_distance::interference_depth_test
