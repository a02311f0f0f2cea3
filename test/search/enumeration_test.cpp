#include "support/enumeration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>

#include "concave_distance/base/error.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"
#include "support/body_pairs.h"

namespace concave_distance::enumeration_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;

using Body = std::shared_ptr<const BodyMesh>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squaredNodeDistance(const Body& a, const Body& b, const Isometry3d& pose, std::size_t i,
                           std::size_t j) {
  return (gridOf(*a).graph().positions[i] - pose * gridOf(*b).graph().positions[j]).squaredNorm();
}

TEST(EnumerateTrianglePairs, IsTheLeastOfAllPairs) {
  RandomEngine engine(2);
  for (std::uint32_t round = 0; round < 20; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round / 3));
    const Isometry3d pose = test::randomPose(engine, 1.5);
    const WitnessPair found = test::enumerateTrianglePairs(*a, *b, pose);
    double least = kInfinity;
    for (std::uint32_t i = 0; i < a->surface().triangleCount(); ++i) {
      for (std::uint32_t j = 0; j < b->surface().triangleCount(); ++j) {
        TrianglePoints on_a;
        TrianglePoints on_b;
        for (int k = 0; k < 3; ++k) {
          on_a[static_cast<std::size_t>(k)] = a->surface().corner(TriangleIndex{i}, k);
          on_b[static_cast<std::size_t>(k)] = pose * b->surface().corner(TriangleIndex{j}, k);
        }
        least = std::min(least, std::sqrt(triangleDistance(on_a, on_b).squared_distance));
      }
    }
    EXPECT_NEAR(std::sqrt(found.squared_distance), least, 8.0 * kTriangleDistanceError);
  }
}

TEST(EnumerateTrianglePairs, KnowsTheDistanceOfBoxes) {
  const Body a = makeBody(test::makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
  RandomEngine engine(3);
  for (int i = 0; i < 50; ++i) {
    const Vector3d half(test::uniformIn(engine, 0.1, 0.5), test::uniformIn(engine, 0.1, 0.5),
                        test::uniformIn(engine, 0.1, 0.5));
    const Body b = makeBody(test::makeCuboid(-half, half));
    const Vector3d shift = test::uniformInCube(engine, 3.0);
    const Vector3d gap = (shift.cwiseAbs() - half - Vector3d::Ones()).cwiseMax(0.0);
    // Inside one another the surfaces still keep their distance.
    const double inside = (Vector3d::Ones() - half - shift.cwiseAbs()).minCoeff();
    const double expected = gap.norm() > 0.0 ? gap.norm() : std::max(inside, 0.0);
    const WitnessPair found = test::enumerateTrianglePairs(*a, *b, test::translation(shift));
    EXPECT_NEAR(std::sqrt(found.squared_distance), expected, 8.0 * kTriangleDistanceError);
  }
}

/// A strip of triangles along x whose upper border is at the given heights: nodes 0 .. n - 1 along it, the
/// lower border far below.
SurfaceMesh profile(const std::vector<double>& heights) {
  const auto n = static_cast<std::uint32_t>(heights.size());
  std::vector<Vector3d> vertices;
  for (std::uint32_t i = 0; i < n; ++i) {
    vertices.emplace_back(0.01 * i, 0.0, heights[i]);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    vertices.emplace_back(0.01 * i, 0.0, -1000.0);
  }
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    triangles.push_back({NodeIndex{i}, NodeIndex{i + 1}, NodeIndex{i + n}});
    triangles.push_back({NodeIndex{i + 1}, NodeIndex{i + 1 + n}, NodeIndex{i + n}});
  }
  return SurfaceMesh(vertices, triangles, "profile");
}

/// One node near, the other two out of reach.
Body farPoint() {
  return makeBody(test::makeSurface({{0, 0, 100}, {0, 0, 9000}, {0, 1, 9000}}, {{0, 1, 2}}));
}

TEST(EnumerateNodeNiches, HandMadeProfileHasThePeaksAndPassesDrawn) {
  // Heights 0 5 2 7 3 7 7 1 6: seen from 100 above, distances 100 95 98 93 97 93 93 99 94 (up to 1e-4).
  const Body a = makeBody(profile({0, 5, 2, 7, 3, 7, 7, 1, 6}));
  const Body b = farPoint();
  const auto niches = test::enumerateNodeNiches(*a, *b, Isometry3d::Identity(), 500.0, 0.0);
  // The first 7 is nearest to x = 0; 7 7 is one summit; 6 and 5 are lower ones.
  ASSERT_EQ(niches.size(), 4U);
  EXPECT_EQ(niches[0].node_a, NodeIndex{3});
  EXPECT_EQ(niches[0].prominence, kInfinity);
  EXPECT_EQ(niches[1].node_a, NodeIndex{5});
  EXPECT_NEAR(niches[1].prominence, 97.0 / 93.0 - 1.0, 1e-4);
  EXPECT_EQ(niches[2].node_a, NodeIndex{8});
  EXPECT_NEAR(niches[2].prominence, 99.0 / 94.0 - 1.0, 1e-4);
  EXPECT_EQ(niches[3].node_a, NodeIndex{1});
  EXPECT_NEAR(niches[3].prominence, 98.0 / 95.0 - 1.0, 1e-4);

  EXPECT_EQ(test::enumerateNodeNiches(*a, *b, Isometry3d::Identity(), 500.0, 0.04).size(), 3U);
  // Below 94.5 the passes are out of reach, and so is the summit at 95.
  const auto cut = test::enumerateNodeNiches(*a, *b, Isometry3d::Identity(), 94.5, 0.0);
  ASSERT_EQ(cut.size(), 3U);
  for (const test::NodeNiche& niche : cut) {
    EXPECT_EQ(niche.prominence, kInfinity);
  }
}

TEST(EnumerateNodeNiches, PlateausCountOnce) {
  const Body a = makeBody(test::makeSheet(8, 8, 0.25));
  const auto parallel = test::enumerateNodeNiches(*a, *a, test::translation(Vector3d(0, 0, 1)), 1.1, 0.0);
  // 81 pairs are exactly one above the other; a step of one gene between two of them is uphill.
  EXPECT_EQ(parallel.front().distance, 1.0);
  std::set<std::pair<std::uint32_t, std::uint32_t>> places;
  for (const test::NodeNiche& niche : parallel) {
    EXPECT_EQ(niche.node_a, niche.node_b);
    EXPECT_TRUE(places.emplace(niche.node_a.value, niche.node_b.value).second);
  }
  // A flat summit of many nodes over one far point is a single niche.
  std::vector<Vector3d> ring;
  std::vector<TriangleNodes> fan;
  for (std::uint32_t i = 0; i < 4; ++i) {
    ring.emplace_back(i == 0 || i == 3 ? 1.0 : -1.0, i < 2 ? 1.0 : -1.0, 0.0);
  }
  ring.emplace_back(0.0, 0.0, -5.0);
  for (std::uint32_t i = 0; i < 4; ++i) {
    fan.push_back({NodeIndex{i}, NodeIndex{(i + 1) % 4}, NodeIndex{4}});
  }
  const Body rim = makeBody(SurfaceMesh(ring, fan, "rim"));
  EXPECT_EQ(test::enumerateNodeNiches(*rim, *farPoint(), Isometry3d::Identity(), 150.0, 0.0).size(), 1U);
}

/// The pass of one local minimum by flooding from it alone, lowest pair first, until a deeper pair is met.
double passFrom(const Body& a, const Body& b, const Isometry3d& pose, double cutoff,
                const test::NodeNiche& niche) {
  using Cell = std::tuple<double, std::uint32_t, std::uint32_t>;
  std::priority_queue<Cell, std::vector<Cell>, std::greater<>> open;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  const auto visit = [&](std::uint32_t i, std::uint32_t j) {
    const double squared_distance = squaredNodeDistance(a, b, pose, i, j);
    if (squared_distance <= cutoff * cutoff && seen.emplace(i, j).second)
      open.emplace(squared_distance, i, j);
  };
  visit(niche.node_a.value, niche.node_b.value);
  const Cell start = open.top();
  double pass = 0.0;
  while (!open.empty()) {
    const Cell cell = open.top();
    open.pop();
    if (cell < start) return std::sqrt(pass);
    const auto [squared_distance, i, j] = cell;
    pass = std::max(pass, squared_distance);
    for (const NodeGraph::Edge& edge : gridOf(*a).graph().edges.row(i)) {
      visit(edge.to.value, j);
    }
    for (const NodeGraph::Edge& edge : gridOf(*b).graph().edges.row(j)) {
      visit(i, edge.to.value);
    }
  }
  return kInfinity;
}

TEST(EnumerateNodeNiches, AgreesWithOneFloodPerLocalMinimum) {
  RandomEngine engine(4);
  for (std::uint32_t round = 0; round < 6; ++round) {
    const Body a = makeBody(test::concaveShape(round), 0.3);
    const Body b = makeBody(test::concaveShape(round + 1), 0.3);
    const Isometry3d pose = test::randomPose(engine, 1.0);
    const double cutoff = 1.5 * std::sqrt(test::enumerateNodePairs(*a, *b, pose).squared_distance) + 0.1;
    const auto niches = test::enumerateNodeNiches(*a, *b, pose, cutoff, 0.0);
    ASSERT_FALSE(niches.empty());
    std::size_t strict_minima = 0;
    for (std::uint32_t i = 0; i < gridOf(*a).graph().nodeCount(); ++i) {
      for (std::uint32_t j = 0; j < gridOf(*b).graph().nodeCount(); ++j) {
        const double here = squaredNodeDistance(a, b, pose, i, j);
        if (here > cutoff * cutoff) continue;
        bool strict = true;
        for (const NodeGraph::Edge& edge : gridOf(*a).graph().edges.row(i)) {
          strict = strict && squaredNodeDistance(a, b, pose, edge.to.value, j) > here;
        }
        for (const NodeGraph::Edge& edge : gridOf(*b).graph().edges.row(j)) {
          strict = strict && squaredNodeDistance(a, b, pose, i, edge.to.value) > here;
        }
        strict_minima += strict ? 1 : 0;
      }
    }
    EXPECT_EQ(niches.size(), strict_minima);
    EXPECT_EQ(niches.front().distance, std::sqrt(test::enumerateNodePairs(*a, *b, pose).squared_distance));
    for (const test::NodeNiche& niche : niches) {
      const double pass = passFrom(a, b, pose, cutoff, niche);
      EXPECT_DOUBLE_EQ(niche.prominence, pass / niche.distance - 1.0);
    }
  }
}

TEST(EnumerateNodeNiches, RefusesMorePairsThanAllowed) {
  const Body a = makeBody(test::makeSheet(8, 8));
  EXPECT_THROW(test::enumerateNodeNiches(*a, *a, Isometry3d::Identity(), 10.0, 0.0, 1000), Error);
}

}  // namespace
}  // namespace concave_distance::enumeration_test
