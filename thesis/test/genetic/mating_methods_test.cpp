#include "thesis/src/genetic/mating_methods.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>

#include "search/search_fixtures.h"

namespace concave_distance::mating_methods_test {
namespace {

// Delta of three nodes adds up along a shortest path but for the rounding of the matrices.
constexpr double kRounding = 0x1.0p-21;

// Carretero, sec. 3.3.2.b: "this radius is centered around the parent with best fitness".
RC_GTEST_PROP(MeshMating, NearTheFitterParentBothChildrenStayWithinItsRadius, ()) {
  static test::MeasuredPair c(test::facingCombs());
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const TrialPoint x = c.drawPoint(engine);
  const TrialPoint y = c.drawPoint(engine);
  const auto [first, second] = mateBy(MatingMethod::MeshNearFitter, c.objective, x, y, c.metric, engine);
  const TrialPoint& fitter = x < y ? x : y;
  const TrialPoint& other = x < y ? y : x;
  const double share = fitterShare(fitter.squared_distance, other.squared_distance);
  for (const TrialPoint& child : {first, second}) {
    for (const bool on_a : {true, false}) {
      const MeshMetric& metric = on_a ? c.metric.onA() : c.metric.onB();
      const NodeIndex from = on_a ? fitter.node_a : fitter.node_b;
      const NodeIndex to = on_a ? other.node_a : other.node_b;
      const NodeIndex node = on_a ? child.node_a : child.node_b;
      const double length = metric.distance(from, to);
      const double gone = metric.distance(from, node);
      RC_ASSERT(gone <= share * length + kRounding * length);
      const double left = metric.distance(node, to);
      RC_ASSERT(std::abs(gone + left - length) <= kRounding * length);
    }
  }
}

// A radius of one edge holds the parent's node and, as likely, the one at the edge's end.
TEST(MeshMating, NearTheFitterParentTheLastNodeWithinTheRadiusIsDrawnToo) {
  test::MeasuredPair c(test::hookAndStairs());
  RandomEngine engine(15);
  int at_parent = 0;
  int beyond = 0;
  for (int i = 0; i < 2000; ++i) {
    const TrialPoint x = c.drawPoint(engine);
    TrialPoint y = x;
    // Parents of equal fitness two edges apart: the radius is one edge.
    const auto edges = gridOf(*c.scene.a).graph().edges.row(x.node_a.value);
    y.node_a = gridOf(*c.scene.a).graph().edges.row(edges[0].to.value)[0].to;
    if (y.node_a == x.node_a) continue;
    const double length = c.metric.onA().distance(x.node_a, y.node_a);
    if (length < 1.9 * static_cast<double>(edges[0].length)) continue;
    const Children children = mateBy(MatingMethod::MeshNearFitter, c.objective, x, y, c.metric, engine);
    (children.first.node_a == std::min(x, y).node_a ? at_parent : beyond) += 1;
  }
  ASSERT_GT(at_parent + beyond, 100);
  EXPECT_GT(beyond, (at_parent + beyond) / 5);
  EXPECT_GT(at_parent, (at_parent + beyond) / 5);
}

RC_GTEST_PROP(PhenotypicMating, ChildrenAreTheNodesNearestToTheLineBetweenTheParents, ()) {
  static test::MeasuredPair c(test::facingCombs());
  const std::uint64_t seed = *rc::gen::arbitrary<std::uint64_t>();
  RandomEngine engine(seed);
  const TrialPoint x = c.drawPoint(engine);
  const TrialPoint y = c.drawPoint(engine);
  const auto [first, second] = mateBy(MatingMethod::Phenotypic, c.objective, x, y, c.metric, engine);
  const NodeGraph& graph = gridOf(*c.scene.a).graph();
  const Eigen::Vector3d from = graph.positions[std::min(x, y).node_a.value];
  const Eigen::Vector3d displacement = graph.positions[std::max(x, y).node_a.value] - from;
  for (const NodeIndex child : {first.node_a, second.node_a}) {
    // Some point of the segment has this node as its nearest: no other is nearer to the child's foot on it.
    bool is_nearest_somewhere = false;
    for (int i = 0; i <= 400 && !is_nearest_somewhere; ++i) {
      const Eigen::Vector3d point = from + i / 400.0 * displacement;
      const double reached = (graph.positions[child.value] - point).norm();
      is_nearest_somewhere =
          std::all_of(graph.positions.begin(), graph.positions.end(), [&](const Eigen::Vector3d& p) {
            return (p - point).norm() >= reached - displacement.norm() / 400.0;  // points between the samples
          });
    }
    RC_ASSERT(is_nearest_somewhere);
  }
}

RC_GTEST_PROP(GenotypicMating, ChildrenHaveIndicesBetweenTheParents, ()) {
  static test::MeasuredPair c(test::facingCombs());
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const TrialPoint x = c.drawPoint(engine);
  const TrialPoint y = c.drawPoint(engine);
  const auto [first, second] = mateBy(MatingMethod::Genotypic, c.objective, x, y, c.metric, engine);
  for (const TrialPoint& child : {first, second}) {
    RC_ASSERT(std::min(x.node_a, y.node_a).value <= child.node_a.value);
    RC_ASSERT(std::max(x.node_a, y.node_a).value >= child.node_a.value);
    RC_ASSERT(std::min(x.node_b, y.node_b).value <= child.node_b.value);
    RC_ASSERT(std::max(x.node_b, y.node_b).value >= child.node_b.value);
  }
}

TEST(Mating, ParentsOnOnePlaceHaveTheirChildrenThere) {
  test::MeasuredPair c(test::facingCombs());
  RandomEngine engine(14);
  const TrialPoint x = c.drawPoint(engine);
  for (const MatingMethod method :
       {MatingMethod::MeshNearFitter, MatingMethod::Phenotypic, MatingMethod::Genotypic}) {
    const auto [first, second] = mateBy(method, c.objective, x, x, c.metric, engine);
    EXPECT_TRUE(samePlace(first, x));
    EXPECT_TRUE(samePlace(second, x));
    EXPECT_TRUE(std::isnan(first.squared_distance)) << "a child's distance is not computed yet";
  }
}

}  // namespace
}  // namespace concave_distance::mating_methods_test
