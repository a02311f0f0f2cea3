// The error bounds of triangle_distance.h against 100 digits and against exact rationals. Worst errors are
// printed: "worst: <family> distance <e> witness <e>", in units of machine epsilon times the largest
// coordinate; CONCAVE_DISTANCE_ACCURACY_PAIRS raises the number of pairs per family (default 1000), as
// doc/numerics.md does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "distance/kernels/triangle_distance.h"
#include "support/case_seed.h"
#include "support/exact_triangle_distance.h"
#include "support/triangle_pairs.h"

namespace concave_distance::triangle_distance_accuracy_test {
namespace {

using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

int pairsPerFamily() {
  const char* const wanted = std::getenv("CONCAVE_DISTANCE_ACCURACY_PAIRS");
  return wanted == nullptr ? test::caseCount(1000) : std::max(1, std::atoi(wanted));
}

std::string corners(const test::TrianglePair& pair) {
  std::ostringstream text;
  text.precision(17);
  for (const TrianglePoints* t : {&pair.first, &pair.second}) {
    for (const Vector3d& corner : *t) {
      text << corner.transpose() << '\n';
    }
  }
  return text.str();
}

double featureError(const TrianglePairDistance& result, const test::TrianglePair& pair) {
  return std::max(test::exactDistance(result.point_a, test::featureOf(pair.first, result.feature_a)),
                  test::exactDistance(result.point_b, test::featureOf(pair.second, result.feature_b)));
}

class EveryFamily : public testing::TestWithParam<test::TrianglePairFamily> {};

TEST_P(EveryFamily, StaysWithinTheStatedBounds) {
  RandomEngine engine(test::caseSeed(20240229));
  double worst_distance = 0.0;
  double worst_witness = 0.0;
  const int count = pairsPerFamily();
  for (int i = 0; i < count; ++i) {
    const test::TrianglePair pair = GetParam().draw(engine);
    const TrianglePairDistance result = triangleDistance(pair.first, pair.second);
    ASSERT_EQ(result.squared_distance, (result.point_b - result.point_a).squaredNorm());
    const double largest = test::largestCoordinate(pair.first, pair.second);
    const double error =
        test::exactDistanceError(std::sqrt(result.squared_distance), pair.first, pair.second);
    ASSERT_LE(error, kTriangleDistanceError * largest) << corners(pair);
    const double witness_error = featureError(result, pair);
    ASSERT_LE(witness_error, kTriangleWitnessError * largest) << corners(pair);
    if (largest == 0.0) continue;
    worst_distance = std::max(worst_distance, error / largest);
    worst_witness = std::max(worst_witness, witness_error / largest);
  }
  std::cout << "worst: " << GetParam().name << " distance " << worst_distance / kEpsilon << " witness "
            << worst_witness / kEpsilon << '\n';
}

TEST_P(EveryFamily, SwappingBodiesAndCornersKeepsTheDistance) {
  RandomEngine engine(test::caseSeed(5));
  for (int i = 0; i < test::caseCount(1000); ++i) {
    const auto [a, b] = GetParam().draw(engine);
    const double d = std::sqrt(triangleDistance(a, b).squared_distance);
    const double bound = 2.0 * kTriangleDistanceError * test::largestCoordinate(a, b);
    EXPECT_NEAR(std::sqrt(triangleDistance(b, a).squared_distance), d, bound);
    EXPECT_NEAR(std::sqrt(triangleDistance({a[1], a[0], a[2]}, {b[2], b[0], b[1]}).squared_distance), d,
                bound);
  }
}

TEST_P(EveryFamily, ScalingByAPowerOfTwoScalesTheAnswerExactly) {
  RandomEngine engine(test::caseSeed(6));
  for (int i = 0; i < test::caseCount(500); ++i) {
    const auto [a, b] = GetParam().draw(engine);
    const TrianglePairDistance one = triangleDistance(a, b);
    for (const double factor : {0x1p-20, 0x1p20}) {
      const TrianglePairDistance other = triangleDistance(test::scaled(a, factor), test::scaled(b, factor));
      EXPECT_EQ(other.point_a, factor * one.point_a);
      EXPECT_EQ(other.point_b, factor * one.point_b);
    }
  }
}

TEST_P(EveryFamily, PointTriangleDistanceStaysWithinTheStatedBounds) {
  RandomEngine engine(test::caseSeed(7));
  for (int i = 0; i < test::caseCount(500); ++i) {
    const test::TrianglePair pair = GetParam().draw(engine);
    const Vector3d& point = pair.second[0];
    const PointTriangleDistance result = pointTriangleDistance(point, pair.first);
    const TrianglePoints as_triangle = {point, point, point};
    const double largest = test::largestCoordinate(pair.first, as_triangle);
    EXPECT_LE(test::exactDistanceError(std::sqrt(result.squared_distance), pair.first, as_triangle),
              kTriangleDistanceError * largest)
        << corners(pair);
    EXPECT_LE(test::exactDistance(result.point, test::featureOf(pair.first, result.feature)),
              kTriangleWitnessError * largest)
        << corners(pair);
  }
}

INSTANTIATE_TEST_SUITE_P(TriangleDistance, EveryFamily, testing::ValuesIn(test::kTrianglePairFamilies),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(TriangleDistance, TenThousandPairsMeetTheKarushKuhnTuckerConditions) {
  // Optimal if and only if neither triangle reaches across the plane through its witness, normal to the
  // direction between the witnesses. The direction is wrong by the witnesses' errors over the distance.
  RandomEngine engine(test::caseSeed(8));
  for (int i = 0; i < test::caseCount(10000); ++i) {
    const test::TrianglePair pair = test::generalPair(engine);
    const TrianglePairDistance result = triangleDistance(pair.first, pair.second);
    const double d = std::sqrt(result.squared_distance);
    if (d == 0.0) continue;
    const double largest = test::largestCoordinate(pair.first, pair.second);
    const double tolerance = kTriangleDistanceError * largest * (1.0 + largest / d);
    const Vector3d direction = (result.point_b - result.point_a) / d;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(direction.dot(pair.first[k] - result.point_a), tolerance) << corners(pair);
      EXPECT_GE(direction.dot(pair.second[k] - result.point_b), -tolerance) << corners(pair);
    }
  }
}

TEST(TriangleDistance, ScalesFromMicrometresToThousandsOfKilometres) {
  RandomEngine engine(test::caseSeed(9));
  for (int i = 0; i < test::caseCount(1000); ++i) {
    const double scale = test::powerOfTen(engine, -6, 6);
    test::TrianglePair pair = test::touchingPair(engine);
    pair = {test::scaled(pair.first, scale), test::scaled(pair.second, scale)};
    EXPECT_LE(test::exactDistanceError(std::sqrt(triangleDistance(pair.first, pair.second).squared_distance),
                                       pair.first, pair.second),
              kTriangleDistanceError * test::largestCoordinate(pair.first, pair.second));
  }
}

TEST(ExactTriangleDistance, AgreesWithRationalArithmetic) {
  RandomEngine engine(test::caseSeed(10));
  for (int i = 0; i < 300; ++i) {  // of the oracle; rationals take their time
    const test::TrianglePair pair = i % 2 == 0 ? test::latticePair(engine) : test::touchingPair(engine);
    const test::Rational exact = test::exactSquaredDistance<test::Rational>(pair.first, pair.second);
    const test::Wide wide = test::exactSquaredDistance<test::Wide>(pair.first, pair.second);
    EXPECT_LE(abs(test::Wide(exact) - wide), test::Wide("1e-60"));
  }
}

}  // namespace
}  // namespace concave_distance::triangle_distance_accuracy_test
