#include "thesis/src/evaluation/niche_questions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "distance/kernels/triangle_distance.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "thesis/src/evaluation/optimum_basin.h"

namespace concave_distance::evaluation::niche_questions_test {
namespace {

using Eigen::Vector3d;

/// A saw above a plate whose top is y = 0:
///
///   3   +-----------------------+
///       |                       |
///   1.5 \      ^       ^        /     passes 1.5
///        \   /   \   /   \    /
///   0.9   \ /     \ /     `v'         three edges along z, each a local minimum:
///   0.5    v      0.7                 0.5 at x = -2, 0.7 at x = 0, 0.9 at x = 2
///
/// Every flank is two triangles, the plate's top two: no triangle pair is smaller than a region.
class SawOverPlate : public ::testing::Test {
 protected:
  SawOverPlate() {
    scene_.a = test::makeBody(test::makeExtrusion({{-3.0, 1.5},
                                                   {-2.0, 0.5},
                                                   {-1.0, 1.5},
                                                   {0.0, 0.7},
                                                   {1.0, 1.5},
                                                   {2.0, 0.9},
                                                   {3.0, 1.5},
                                                   {3.0, 3.0},
                                                   {-3.0, 3.0}},
                                                  2.0),
                              0.5);
    scene_.b = test::makeBody(test::makeCuboid({-5.0, -1.0, -5.0}, {5.0, 0.0, 5.0}), 0.5);
    scene_.instants.resize(1);
    scene_.instants[0].a_from_b.setIdentity();
    scene_.instants[0].exact_distance = 0.5;
    scene_.instants[0].niche_cutoff = std::numeric_limits<double>::infinity();
    LocalMinimaRequest request;
    request.through_material = true;
    scene_.instants[0].minima =
        findLocalMinima(*scene_.a, *scene_.b, scene_.instants[0].a_from_b, request).niches;
  }

  enum class Pick { First, Last };
  /// Which of the triangles around the point is named.
  static TriangleIndex triangleAt(const BodyMesh& body, const Vector3d& point, Pick pick) {
    TriangleIndex found{body.surface().triangleCount()};
    for (std::size_t t = 0; t < body.surface().triangleCount(); ++t) {
      TrianglePoints corners;
      for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] = body.surface().corner(TriangleIndex{t}, k);
      if (pointTriangleDistance(point, corners).squared_distance > 1e-24) continue;
      found = TriangleIndex{t};
      if (pick == Pick::First) break;
    }
    EXPECT_LT(found.value, body.surface().triangleCount()) << point.transpose();
    return found;
  }
  FoundPlace placeOf(const Vector3d& on_a, const Vector3d& on_b, Pick pick) const {
    return {triangleAt(*scene_.a, on_a, pick), triangleAt(*scene_.b, on_b, pick), (on_a - on_b).norm()};
  }
  /// The saw's point and the plate's below it.
  FoundPlace above(double x, double y, double z, Pick pick = Pick::First) const {
    return placeOf({x, y, z}, {x, 0.0, z}, pick);
  }
  TrialRecord measured(const std::vector<FoundPlace>& reported,
                       const std::vector<FoundPlace>& met = {}) const {
    NicheQuestions questions(scene_);
    questions.ask(0, 0, {reported, met});
    std::vector<TrialRecord> records(1);
    questions.settle(records);
    return records[0];
  }

  SceneTruth scene_;
};

TEST_F(SawOverPlate, HasTheThreeNichesOfItsEdges) {
  ASSERT_EQ(nicheCount(scene_.instants[0]), 3U);
  const double expected[] = {0.5, 0.7, 0.9};
  std::size_t i = 0;
  for (const LocalMinimum& minimum : scene_.instants[0].minima) {
    if (!isNiche(scene_.instants[0], minimum)) continue;
    EXPECT_NEAR(minimum.distance, expected[i], 1e-12);
    ++i;
  }
}

TEST_F(SawOverPlate, HiddenNichesCountUnlessTheVisibleAloneAreAskedFor) {
  // As if something stood before the second edge.
  std::vector<LocalMinimum>& minima = scene_.instants[0].minima;
  const auto second = std::find_if(minima.begin(), minima.end(), [](const LocalMinimum& minimum) {
    return std::abs(minimum.distance - 0.7) < 1e-12;
  });
  ASSERT_NE(second, minima.end());
  second->visible = false;
  const std::vector<FoundPlace> visible = {above(-2.0, 0.5, 0.3), above(2.0, 0.9, 0.0)};
  const std::vector<FoundPlace> hidden = {above(0.0, 0.7, -0.9)};
  EXPECT_EQ(nicheCount(scene_.instants[0]), 3U);
  EXPECT_NEAR(measured(visible).recall, 2.0 / 3.0, 1e-12);
  scene_.instants[0].hidden_count = false;
  EXPECT_EQ(nicheCount(scene_.instants[0]), 2U);
  EXPECT_EQ(measured(visible).recall, 1.0);
  EXPECT_EQ(measured(hidden).recall, 0.0);
  EXPECT_EQ(measured(hidden).precision, 0.0);
}

TEST_F(SawOverPlate, AListOfAllNichesHasRecallOne) {
  for (const Pick pick : {Pick::First, Pick::Last}) {
    const TrialRecord record =
        measured({above(-2.0, 0.5, 0.3, pick), above(0.0, 0.7, -0.9, pick), above(2.0, 0.9, 0.0, pick)});
    EXPECT_EQ(record.recall, 1.0);
    EXPECT_EQ(record.precision, 1.0);
    EXPECT_EQ(record.nearest, 1.0);
  }
}

TEST_F(SawOverPlate, AListWithOneDoubledAndOneMissingHasNot) {
  for (const Pick pick : {Pick::First, Pick::Last}) {
    const TrialRecord record =
        measured({above(-2.0, 0.5, 0.9, pick), above(-2.0, 0.5, -0.9, pick), above(2.0, 0.9, 0.0, pick)});
    EXPECT_DOUBLE_EQ(record.recall, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(record.precision, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(record.archive_recall, 2.0 / 3.0);
  }
}

TEST_F(SawOverPlate, APairOnAFlankBelongsToTheEdgeBelow) {
  const FoundPlace flank = above(2.5, 1.2, 0.4);
  EXPECT_DOUBLE_EQ(measured({flank}).recall, 1.0 / 3.0);
  EXPECT_EQ(measured({flank}).nearest, 0.0);
  EXPECT_DOUBLE_EQ(measured({flank, above(2.0, 0.9, 0.0)}).recall, 1.0 / 3.0);
  EXPECT_EQ(measured({above(-2.5, 1.0, 0.4)}).nearest, 1.0);
}

TEST_F(SawOverPlate, APairAboveThePassesBelongsToNone) {
  const FoundPlace valley = above(-1.0, 1.5, 0.2);
  // On the first edge, but so far aside that the second can be reached without rising.
  const FoundPlace oblique = placeOf({-2.0, 0.5, 0.0}, {-2.0, 0.0, 1.6}, Pick::First);
  for (const FoundPlace& place : {valley, oblique}) {
    EXPECT_EQ(measured({place}).recall, 0.0);
    EXPECT_EQ(measured({place}).precision, 0.0);
    EXPECT_EQ(measured({place}).nearest, 0.0);
  }
}

TEST_F(SawOverPlate, APairThroughMaterialIsNoNiche) {
  // From the saw's teeth to the plate's bottom, its dark side.
  const FoundPlace dark = placeOf({-2.0, 0.5, 0.0}, {-2.0, -1.0, 0.0}, Pick::First);
  EXPECT_EQ(measured({dark}).precision, 0.0);
}

TEST_F(SawOverPlate, MinimaThatWereMetCountApartFromThoseReported) {
  const TrialRecord record = measured({above(0.0, 0.7, 0.0)}, {above(-2.0, 0.5, 0.0), above(2.0, 0.9, 0.0)});
  EXPECT_DOUBLE_EQ(record.recall, 1.0 / 3.0);
  EXPECT_EQ(record.archive_recall, 1.0);
}

TEST_F(SawOverPlate, BeyondTheCutoffNothingIsCounted) {
  scene_.instants[0].niche_cutoff = 0.8;
  std::vector<LocalMinimum>& minima = scene_.instants[0].minima;
  minima.erase(std::remove_if(minima.begin(), minima.end(),
                              [](const LocalMinimum& minimum) { return minimum.distance > 0.8; }),
               minima.end());
  const TrialRecord record = measured({above(-2.0, 0.5, 0.0), above(2.0, 0.9, 0.0)});
  EXPECT_DOUBLE_EQ(record.recall, 0.5);
  EXPECT_DOUBLE_EQ(record.precision, 0.5);
}

TEST_F(SawOverPlate, AnAnswerIsInTheRegionOfTheOptimumWhereADescentLeadsThere) {
  scene_.instants[0].region_limit = 0.55;
  // High on the first tooth: far above the optimum and above the second niche, but on the way down to it.
  EXPECT_TRUE(leadsToOptimum(scene_, Vector3d(-1.4, 1.1, 0.2), Vector3d(-1.4, 0.0, 0.3)));
  EXPECT_TRUE(leadsToOptimum(scene_, Vector3d(-2.6, 1.1, 0.2), Vector3d(-2.9, 0.0, 0.3)));
  EXPECT_FALSE(leadsToOptimum(scene_, Vector3d(-0.3, 0.94, 0.2), Vector3d(-0.3, 0.0, 0.3)));
  EXPECT_FALSE(leadsToOptimum(scene_, Vector3d(2.0, 0.9, 0.2), Vector3d(2.0, 0.0, 0.3)));
}

}  // namespace
}  // namespace concave_distance::evaluation::niche_questions_test
