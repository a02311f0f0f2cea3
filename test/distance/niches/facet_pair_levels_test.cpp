#include "distance/niches/facet_pair_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/case_seed.h"
#include "support/exact_triangle_distance.h"
#include "support/triangle_pairs.h"

namespace concave_distance::facet_pair_levels_test {
namespace {

class LevelsOfEveryFamily : public testing::TestWithParam<test::TrianglePairFamily> {};

TEST_P(LevelsOfEveryFamily, LevelsOfACellAreTheDistancesOfEachEdgeWithinTheKernelsBound) {
  RandomEngine engine(20240301);
  for (int i = 0; i < 300; ++i) {
    const auto [a, b] = GetParam().draw(engine);
    const detail::FacetPairLevels levels =
        detail::facetPairLevels({{a[0], a[1], a[2], a[0]}}, {{b[0], b[1], b[2], b[0]}});
    const double bound = kTriangleDistanceError * test::largestCoordinate(a, b);
    ASSERT_LE(test::exactDistanceError(std::sqrt(levels.least()), a, b), bound);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      ASSERT_LE(test::exactDistanceError(std::sqrt(levels.edges_of_a[k]), {a[k], a[next], a[next]}, b), bound)
          << i;
      ASSERT_LE(test::exactDistanceError(std::sqrt(levels.edges_of_b[k]), a, {b[k], b[next], b[next]}), bound)
          << i;
    }
  }
}

/// Four points of an ellipse: convex, as flat as rounding leaves it.
detail::FacetPoints randomQuad(RandomEngine& engine, double apart) {
  std::array<double, 4> angles;
  for (double& angle : angles) angle = test::uniformIn(engine, 0.0, 2.0 * M_PI);
  std::sort(angles.begin(), angles.end());
  const double width = test::powerOfTen(engine, -1.0, 0.0);
  const Eigen::Matrix3d rotation = test::randomRotation(engine);
  const Eigen::Vector3d middle = apart * test::uniformInCube(engine, 1.0);
  detail::FacetPoints quad;
  quad.is_quad = true;
  for (std::size_t k = 0; k < 4; ++k) {
    quad.corners[k] =
        middle + rotation * Eigen::Vector3d(std::cos(angles[k]), width * std::sin(angles[k]), 0.0);
  }
  return quad;
}

/// Of the closest pair of their triangles, how far `distance` is off, metres.
double exactError(double distance, const detail::FacetPoints& a, const detail::FacetPoints& b) {
  const detail::FacetPairDistance found = detail::facetDistance(a, b);
  return test::exactDistanceError(distance, found.is_in_second_of_a ? a.second() : a.first(),
                                  found.is_in_second_of_b ? b.second() : b.first());
}

TEST(FacetPairLevels, OfQuadranglesAreTheDistancesOfTheirTriangles) {
  RandomEngine engine(test::caseSeed(20261123));
  const auto edge_of = [](const detail::FacetPoints& quad, std::size_t k) -> detail::FacetPoints {
    const Eigen::Vector3d& to = quad.corners[(k + 1) % 4];
    return {{quad.corners[k], to, to, quad.corners[k]}};
  };
  for (int i = 0; i < test::caseCount(450); ++i) {
    const double apart = test::powerOfTen(engine, -2.0, 1.5);
    const detail::FacetPoints a = randomQuad(engine, apart);
    detail::FacetPoints b = randomQuad(engine, apart);
    if (i % 3 == 0) {  // a triangle
      b.is_quad = false;
      b.corners[3] = b.corners[0];
    } else if (i % 3 == 1) {  // in parallel
      const Eigen::Vector3d normal = (a.corners[1] - a.corners[0]).cross(a.corners[2] - a.corners[0]);
      for (std::size_t k = 0; k < 4; ++k) b.corners[k] = a.corners[k] + apart * normal;
    }
    const detail::FacetPairLevels levels = detail::facetPairLevels(a, b);
    double largest = 0.0;
    for (const detail::FacetPoints& quad : {a, b}) {
      for (const Eigen::Vector3d& corner : quad.corners) {
        largest = std::max(largest, corner.cwiseAbs().maxCoeff());
      }
    }
    // Once for the levels, once for which triangles are closest.
    const double bound = 2.0 * kTriangleDistanceError * largest;
    ASSERT_LE(exactError(std::sqrt(levels.least()), a, b), bound) << i;
    for (std::size_t k = 0; k < a.edgeCount(); ++k) {
      ASSERT_LE(exactError(std::sqrt(levels.edges_of_a[k]), edge_of(a, k), b), bound) << i;
    }
    for (std::size_t k = 0; k < b.edgeCount(); ++k) {
      ASSERT_LE(exactError(std::sqrt(levels.edges_of_b[k]), a, edge_of(b, k)), bound) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(FacetPairLevels, LevelsOfEveryFamily, testing::ValuesIn(test::kTrianglePairFamilies),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace concave_distance::facet_pair_levels_test
