#include "support/concave_shapes.h"

#include <gtest/gtest.h>

#include <map>

namespace concave_distance::concave_shapes_test {
namespace {

double volume(const SurfaceMesh& mesh) {
  double six_fold = 0.0;
  for (const TriangleNodes& t : mesh.triangles()) {
    six_fold += mesh.vertex(t[0]).dot(mesh.vertex(t[1]).cross(mesh.vertex(t[2])));
  }
  return six_fold / 6.0;
}

bool isClosed(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const TriangleNodes& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++uses[{t[k].value, t[(k + 1) % 3].value}];
    }
  }
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) {
      return false;
    }
  }
  return true;
}

TEST(ConcaveShapes, AreClosedAndEncloseTheVolumeOfTheirOutline) {
  EXPECT_TRUE(isClosed(test::makeComb(5, 0.1, 0.15, 0.4, 0.1, 0.2)));
  EXPECT_NEAR(volume(test::makeComb(5, 0.1, 0.15, 0.4, 0.1, 0.2)), (5 * 0.04 + 1.1 * 0.1) * 0.2, 1e-12);
  EXPECT_TRUE(isClosed(test::makeStairs(4, 0.2, 0.15, 0.6)));
  EXPECT_NEAR(volume(test::makeStairs(4, 0.2, 0.15, 0.6)), 0.2 * 0.15 * (1 + 2 + 3 + 4) * 0.6, 1e-12);
  EXPECT_TRUE(isClosed(test::makeLShape(0.6, 0.15, 0.2)));
  EXPECT_NEAR(volume(test::makeLShape(0.6, 0.15, 0.2)), (0.6 * 0.15 + 0.45 * 0.15) * 0.2, 1e-12);
  EXPECT_TRUE(isClosed(test::makeHook(0.8, 0.35, 0.25, 0.1, 0.1)));
  EXPECT_NEAR(volume(test::makeHook(0.8, 0.35, 0.25, 0.1, 0.1)), (0.08 + 0.025 + 0.035) * 0.1, 1e-12);
}

}  // namespace
}  // namespace concave_distance::concave_shapes_test
