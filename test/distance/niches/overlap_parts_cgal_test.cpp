#include <gtest/gtest.h>

#include "distance/niches/local_minima.h"
#include "support/body_pairs.h"
#include "support/case_seed.h"
#include "support/cgal_overlap.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

/// The niches at distance 0 of two solids against the connected parts of their overlap by CGAL's exact
/// Booleans.
namespace concave_distance::overlap_parts_cgal_test {
namespace {

using test::makeBody;

/// Parts of less volume, m^3, are a matter of rounding.
constexpr double kLeastVolume = 1e-12;

SurfaceMesh drawSolid(RandomEngine& engine) {
  if (uniformIndex(engine, 2) == 0) return test::randomSolid(engine);
  return test::concaveShape(uniformIndex(engine, 4));
}

TEST(OverlapPartsAgainstCgal, AreAsManyAsTheExactOverlapHas) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(150);
  std::uint64_t several = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "parts of overlaps", i));
    const SurfaceMesh a = drawSolid(engine);
    const SurfaceMesh b = drawSolid(engine);
    const Eigen::Isometry3d pose = test::randomOverlappingPose(a, b, engine);
    const test::OverlapTruth truth = test::cgalOverlap(a, test::movedSurface(b, pose));
    if (!truth.known) continue;
    std::size_t parts = 0;
    std::size_t doubtful = 0;
    for (const test::OverlapPart& part : truth.parts) ++(part.volume > kLeastVolume ? parts : doubtful);
    LocalMinimaRequest request;
    request.hidden = false;
    request.cutoff = 0.0;
    const LocalMinima found = findLocalMinima(*makeBody(a), *makeBody(b), pose, request);
    // A body that the other one swallows meets it nowhere.
    if (found.niches.empty() && parts == 1) continue;
    SCOPED_TRACE("case " + std::to_string(i) + " of seed " + std::to_string(seed));
    EXPECT_TRUE(found.finished);
    EXPECT_GE(found.niches.size(), parts);
    EXPECT_LE(found.niches.size(), parts + doubtful);
    several += parts > 1 ? 1 : 0;
  }
  EXPECT_GT(several, cases / 10);
}

}  // namespace
}  // namespace concave_distance::overlap_parts_cgal_test
