#include <gtest/gtest.h>

#include <algorithm>

#include "concave_distance/interference/interference.h"
#include "interference/interference_checks.h"
#include "support/cgal_overlap.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

namespace concave_distance::interference_cgal_test {
namespace {

TEST(InterferenceOfRandomConcavePairs, HasTheRegionsVolumesAndAreasOfCgalsBooleans) {
  InterferenceWorkspace workspace;
  Interference result;
  std::size_t overlapping = 0;
  std::size_t several = 0;
  std::size_t unknown = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const SurfaceMesh a = test::randomSolid(engine);
    const SurfaceMesh b = test::randomSolid(engine);
    const Eigen::Isometry3d pose = test::randomOverlappingPose(a, b, engine);
    findInterference(*test::makeBody(a), *test::makeBody(b), pose, workspace, result);
    const test::OverlapTruth truth = test::cgalOverlap(a, test::movedSurface(b, pose));
    unknown += truth.known ? 0U : 1U;
    if (!truth.known) continue;
    overlapping += truth.parts.empty() ? 0U : 1U;
    several += truth.parts.size() > 1 ? 1U : 0U;
    ASSERT_EQ(result.regions.size(), truth.parts.size());
    const double size = std::max(a.diameter(), b.diameter());
    double area_a = 0.0;
    double area_b = 0.0;
    for (const InterferenceRegion& region : result.regions) {
      area_a += region.surface_area_a;
      area_b += region.surface_area_b;
      EXPECT_TRUE(region.consistent);
      EXPECT_TRUE(region.closed);
    }
    EXPECT_NEAR(area_a, truth.area_a, std::max(1e-9 * truth.area_a, 1e-12 * size * size));
    EXPECT_NEAR(area_b, truth.area_b, std::max(1e-9 * truth.area_b, 1e-12 * size * size));
    std::sort(result.regions.begin(), result.regions.end(),
              [](const InterferenceRegion& l, const InterferenceRegion& r) { return l.volume > r.volume; });
    for (std::size_t i = 0; i < truth.parts.size(); ++i) {
      const double tolerance = std::max(1e-9 * truth.parts[i].volume, 1e-12 * size * size * size);
      EXPECT_NEAR(result.regions[i].volume, truth.parts[i].volume, tolerance);
    }
  }
  EXPECT_GT(overlapping, 200u);
  EXPECT_GT(several, 30u);
  EXPECT_LT(unknown, 10u);
}

}  // namespace
}  // namespace concave_distance::interference_cgal_test
