#include "distance/niches/basin_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/minima/minima_tracker.h"
#include "support/body_motions.h"
#include "support/body_pairs.h"

namespace concave_distance::detail::basin_boundary_test {
namespace {

using Eigen::Vector3d;
using test::makeBody;
using Body = std::shared_ptr<const BodyMesh>;

// After any motion the rest of a boundary keeps its distance, and what has left it does not.
TEST(BasinBoundary, LosesExactlyWhatComesNearerThanTheLevel) {
  RandomEngine engine(23);
  std::size_t lost = 0;
  std::size_t unmeasured = 0;
  std::size_t kept = 0;
  for (std::uint32_t run = 0; run < 200; ++run) {
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const test::Motion motion = test::randomMotion(engine);
    const double step = std::pow(10.0, -4.0 + 3.0 * uniformUnit(engine));
    const PairFrame first = PairFrame::withFacets(*a, *b, motion.at(0.0));
    WorkLimit none;
    BasinBoundary boundary;
    BoundaryPool pool;
    boundary.begin(pool, Vector3d::Zero(), Vector3d::Zero());
    std::vector<SharedElement> left;
    const double level = 0.3 + uniformUnit(engine);
    for (std::uint32_t k = 0; k < 200; ++k) {
      const Side side = uniformIndex(engine, 2) == 0 ? Side::A : Side::B;
      const SurfaceMesh& own = (side == Side::A ? a : b)->surface();
      const SurfaceMesh& other = (side == Side::A ? b : a)->surface();
      const TriangleIndex t{uniformIndex(engine, static_cast<std::uint32_t>(own.triangleCount()))};
      const SharedElement element{
          side, own.triangle(t)[0], own.triangle(t)[k % 3],
          TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(other.triangleCount()))}};
      const double distance = std::sqrt(closestOver(first, element).squared_distance);
      if (distance < level) continue;
      boundary.add(pool, first, {element, t}, distance);
      left.push_back(element);
    }
    for (int k = 1; k < 30; ++k) {
      const PairFrame scene = PairFrame::withFacets(*a, *b, motion.at(step * k));
      WorkLimit over(WorkLimit::Clock::now(), 0.0, std::numeric_limits<std::size_t>::max(), nullptr);
      boundary.takeCrossed(pool, scene, level, over);
      ASSERT_TRUE(pool.crossed.empty()) << "nothing is measured after the limit";
      ASSERT_EQ(boundary.size(pool), left.size()) << "and nothing gets lost";
      unmeasured += pool.has_unmeasured ? 1 : 0;
      boundary.takeCrossed(pool, scene, level, none);
      ASSERT_FALSE(pool.has_unmeasured);
      const std::size_t crossed = pool.crossed.size();
      const auto nearer = [&](const SharedElement& element) {
        return std::sqrt(closestOver(scene, element).squared_distance) < level;
      };
      const auto gone = std::remove_if(left.begin(), left.end(), nearer);
      ASSERT_EQ(static_cast<std::size_t>(left.end() - gone), crossed) << "run " << run << ", instant " << k;
      left.erase(gone, left.end());
      ASSERT_EQ(boundary.size(pool), left.size());
      lost += crossed;
    }
    kept += left.size();
  }
  EXPECT_GT(lost, 1000U);
  EXPECT_GT(unmeasured, 0U);
  EXPECT_GT(kept, 1000U);
}

}  // namespace
}  // namespace concave_distance::detail::basin_boundary_test
