#include "distance/kernels/triangle_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/exact_triangle_distance.h"
#include "support/triangle_pairs.h"

namespace concave_distance::triangle_distance_test {
namespace {

using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
const TrianglePoints kFlat = {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)};

double distanceOf(const TrianglePoints& a, const TrianglePoints& b) {
  return std::sqrt(triangleDistance(a, b).squared_distance);
}

TEST(TriangleDistance, VertexOverFace) {
  const TrianglePoints above = {Vector3d(1, 1, 0.5), Vector3d(1, 2, 3), Vector3d(2, 1, 4)};
  const TrianglePairDistance result = triangleDistance(kFlat, above);
  EXPECT_EQ(result.squared_distance, 0.25);
  EXPECT_EQ(result.feature_a, Feature::Face);
  EXPECT_EQ(result.feature_b, Feature::Vertex0);
  EXPECT_LT((result.point_a - Vector3d(1, 1, 0)).norm(), 4 * kEpsilon);
  EXPECT_EQ(result.point_b, above[0]);
  const TrianglePairDistance mirrored = triangleDistance(above, kFlat);
  EXPECT_EQ(mirrored.feature_a, Feature::Vertex0);
  EXPECT_EQ(mirrored.feature_b, Feature::Face);
}

TEST(TriangleDistance, CrossedEdges) {
  const TrianglePoints across = {Vector3d(2, -1, 1), Vector3d(2, 1, 1), Vector3d(2, 0, 9)};
  const TrianglePoints below = {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(2, 0, -5)};
  const TrianglePairDistance result = triangleDistance(below, across);
  EXPECT_EQ(result.squared_distance, 1.0);
  EXPECT_EQ(result.feature_a, Feature::Edge0);
  EXPECT_EQ(result.feature_b, Feature::Edge0);
  EXPECT_EQ(result.point_a, Vector3d(2, 0, 0));
  EXPECT_EQ(result.point_b, Vector3d(2, 0, 1));
}

TEST(TriangleDistance, VertexAgainstVertex) {
  const TrianglePoints b = {Vector3d(-1, -2, -2), Vector3d(-9, -2, -2), Vector3d(-1, -9, -3)};
  const TrianglePairDistance result = triangleDistance(kFlat, b);
  EXPECT_EQ(result.squared_distance, 9.0);
  EXPECT_EQ(result.feature_a, Feature::Vertex0);
  EXPECT_EQ(result.feature_b, Feature::Vertex0);
}

TEST(TriangleDistance, ParallelTrianglesAreTheirHeightApartWhereTheyOverlap) {
  for (const Vector3d& shift :
       {Vector3d(0, 0, 2), Vector3d(1, 0.5, 2), Vector3d(-3, 1, 2), Vector3d(3.9, 0, 2)}) {
    EXPECT_NEAR(distanceOf(kFlat, test::moved(kFlat, Eigen::Matrix3d::Identity(), shift)), 2.0,
                8 * kTriangleDistanceError);
  }
  // One wholly over the other's inside.
  const TrianglePoints small = {Vector3d(1, 1, 2), Vector3d(1.5, 1, 2), Vector3d(1, 1.5, 2)};
  EXPECT_EQ(distanceOf(kFlat, small), 2.0);
  EXPECT_EQ(distanceOf(small, kFlat), 2.0);
}

TEST(TriangleDistance, CoplanarTriangles) {
  const TrianglePoints apart = {Vector3d(5, 0, 0), Vector3d(6, -1, 0), Vector3d(6, 1, 0)};
  EXPECT_EQ(distanceOf(kFlat, apart), 1.0);
  const TrianglePoints overlapping = {Vector3d(1, 1, 0), Vector3d(9, 1, 0), Vector3d(9, 2, 0)};
  EXPECT_EQ(distanceOf(kFlat, overlapping), 0.0);
  const TrianglePoints inside = {Vector3d(1, 1, 0), Vector3d(1.25, 1, 0), Vector3d(1, 1.25, 0)};
  EXPECT_EQ(distanceOf(kFlat, inside), 0.0);
  EXPECT_EQ(distanceOf(inside, kFlat), 0.0);
  EXPECT_EQ(distanceOf(kFlat, kFlat), 0.0);
}

TEST(TriangleDistance, CrossingTrianglesShareOneWitness) {
  const TrianglePoints piercing = {Vector3d(1, 1, -3), Vector3d(1, 1, 5), Vector3d(1.5, 1, 5)};
  for (const bool swapped : {false, true}) {
    const TrianglePairDistance result =
        swapped ? triangleDistance(piercing, kFlat) : triangleDistance(kFlat, piercing);
    EXPECT_EQ(result.squared_distance, 0.0);
    EXPECT_EQ(result.point_a, result.point_b);
    EXPECT_LE(test::exactDistance(result.point_a, kFlat), kTriangleWitnessError * 5);
    EXPECT_LE(test::exactDistance(result.point_a, piercing), kTriangleWitnessError * 5);
  }
  const TrianglePairDistance result = triangleDistance(kFlat, piercing);
  EXPECT_EQ(result.feature_a, Feature::Face);
  EXPECT_EQ(result.feature_b, Feature::Edge0);
  EXPECT_EQ(result.point_a, Vector3d(1, 1, 0));
}

TEST(TriangleDistance, TouchingTrianglesAreAtDistanceZero) {
  const TrianglePoints standing = {Vector3d(1, 1, 0), Vector3d(1, 2, 3), Vector3d(2, 1, 4)};
  EXPECT_EQ(distanceOf(kFlat, standing), 0.0);
  const TrianglePoints at_edge = {Vector3d(2, 0, 0), Vector3d(2, -1, 3), Vector3d(2, -1, -4)};
  EXPECT_EQ(distanceOf(kFlat, at_edge), 0.0);
  const TrianglePoints at_vertex = {Vector3d(4, 0, 0), Vector3d(5, -1, 3), Vector3d(6, -1, -4)};
  EXPECT_EQ(distanceOf(kFlat, at_vertex), 0.0);
  const TrianglePoints along_edge = {Vector3d(1, 0, 0), Vector3d(7, 0, 0), Vector3d(2, -1, -4)};
  EXPECT_EQ(distanceOf(kFlat, along_edge), 0.0);
}

TEST(TriangleDistance, SegmentsAndPointsAreTrianglesToo) {
  const Vector3d p(1, 1, 3);
  EXPECT_EQ(distanceOf(kFlat, {p, p, p}), 3.0);
  EXPECT_EQ(distanceOf({p, p, p}, kFlat), 3.0);
  const Vector3d q(1, 1, -1);
  EXPECT_EQ(distanceOf(kFlat, {p, q, q}), 0.0);
  EXPECT_EQ(distanceOf(kFlat, {q, p, q}), 0.0);
  EXPECT_EQ(distanceOf({p, p, p}, {q, q, q}), 4.0);
  EXPECT_EQ(distanceOf({p, p, p}, {p, p, p}), 0.0);
  // A segment as three collinear corners, over an edge and beside one.
  EXPECT_EQ(distanceOf(kFlat, {Vector3d(1, 1, 2), Vector3d(2, 1, 2), Vector3d(30, 1, 2)}), 2.0);
  EXPECT_EQ(distanceOf(kFlat, {Vector3d(1, -2, 0), Vector3d(2, -2, 0), Vector3d(30, -2, 0)}), 2.0);
  const Vector3d zero = Vector3d::Zero();
  EXPECT_EQ(distanceOf({zero, zero, zero}, {zero, zero, zero}), 0.0);
}

TEST(TriangleDistance, CornersThatAllButCoincideOrAlign) {
  for (const double scale : {0.01, 1.0, 100.0}) {
    for (const double part : {0.75, 1.5}) {
      const double step = part * kEpsilon * scale;
      const Vector3d p = scale * Vector3d(0.25, 0.25, 2);
      const TrianglePoints tiny = {p, p + Vector3d(step, 0, 0), p + Vector3d(0, step, 0)};
      EXPECT_NEAR(distanceOf(test::scaled(kFlat, scale), tiny), 2 * scale,
                  kTriangleDistanceError * 4 * scale);
      const double angle = part * std::asin(kEpsilon);
      const TrianglePoints aligned = {p, p + Vector3d(scale, 0, 0),
                                      p + 2 * scale * Vector3d(std::cos(angle), std::sin(angle), 0)};
      EXPECT_NEAR(distanceOf(test::scaled(kFlat, scale), aligned), 2 * scale,
                  kTriangleDistanceError * 4 * scale);
    }
  }
}

TEST(TriangleDistance, SliverOf15MetresBy5Millimetres) {
  // The sizes of a pair on which an iterative kernel failed to converge (coal, test/gjk.cpp).
  const TrianglePoints sliver = {Vector3d(-7.3645, 0, 0), Vector3d(7.3645, 0, 0),
                                 Vector3d(-7.3645, 0.0053, 0)};
  RandomEngine engine(11);
  for (int i = 0; i < 2000; ++i) {
    const TrianglePoints small = test::moved(
        {Vector3d(0, 0, 0), Vector3d(0.006, 0, 0), Vector3d(0, 0.006, 0)}, test::randomRotation(engine),
        Vector3d(test::uniformIn(engine, -8, 8), test::uniformIn(engine, -0.01, 0.01),
                 test::powerOfTen(engine, -12, 1)));
    const double bound = kTriangleDistanceError * test::largestCoordinate(sliver, small);
    EXPECT_LE(test::exactDistanceError(distanceOf(sliver, small), sliver, small), bound);
    EXPECT_LE(test::exactDistanceError(distanceOf(small, sliver), sliver, small), bound);
  }
}

TEST(TriangleDistance, HoldsAtTheEndsOfTheNumberRange) {
  const TrianglePoints above = {Vector3d(1, 1, 0.5), Vector3d(1, 2, 3), Vector3d(2, 1, 4)};
  for (const int exponent : {-500, -300, -160, 160, 300, 500}) {
    const double scale = std::ldexp(1.0, exponent);
    const TrianglePairDistance result =
        triangleDistance(test::scaled(kFlat, scale), test::scaled(above, scale));
    EXPECT_EQ((result.point_b - result.point_a) / scale, Vector3d(0, 0, 0.5)) << "2^" << exponent;
  }
}

TEST(PointTriangleDistance, ReachesEveryFeature) {
  const auto expect = [](const Vector3d& point, const Vector3d& closest, Feature feature) {
    const PointTriangleDistance result = pointTriangleDistance(point, kFlat);
    EXPECT_LT((result.point - closest).norm(), 4 * kTriangleWitnessError) << point.transpose();
    EXPECT_EQ(result.feature, feature) << point.transpose();
    EXPECT_EQ(result.squared_distance, (result.point - point).squaredNorm());
  };
  expect({1, 1, 2}, {1, 1, 0}, Feature::Face);
  expect({-1, -1, 2}, {0, 0, 0}, Feature::Vertex0);
  expect({5, -1, 2}, {4, 0, 0}, Feature::Vertex1);
  expect({-1, 5, 2}, {0, 4, 0}, Feature::Vertex2);
  expect({2, -1, 2}, {2, 0, 0}, Feature::Edge0);
  expect({3, 3, 2}, {2, 2, 0}, Feature::Edge1);
  expect({-1, 2, 2}, {0, 2, 0}, Feature::Edge2);
}

}  // namespace
}  // namespace concave_distance::triangle_distance_test
