#include "distance/cell_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/exact_triangle_distance.h"
#include "support/triangle_pairs.h"

namespace concave_distance {
namespace {

class EveryFamily : public testing::TestWithParam<test::TrianglePairFamily> {};

TEST_P(EveryFamily, LevelsOfACellAreTheDistancesOfEachEdgeWithinTheKernelsBound) {
  RandomEngine engine(20240301);
  for (int i = 0; i < 300; ++i) {
    const auto [a, b] = GetParam().draw(engine);
    const detail::CellLevels levels =
        detail::cellLevels({{a[0], a[1], a[2], a[0]}}, {{b[0], b[1], b[2], b[0]}});
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

INSTANTIATE_TEST_SUITE_P(CellLevels, EveryFamily, testing::ValuesIn(test::kTrianglePairFamilies),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace concave_distance
