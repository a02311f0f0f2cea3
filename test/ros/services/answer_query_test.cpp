#include "ros/services/answer_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros/box_scene.h"
#include "ros/pair_demands.h"
#include "support/plain_shapes.h"

namespace concave_distance::answer_query_test {
namespace {

using test::kRounding;

class AnswerQuery : public ::testing::Test {
 protected:
  AnswerQuery() {
    place(buffer, "a", 0.0, now);
    place(buffer, "b", 2.0, now);
    place(buffer, "c", -3.0, now);
    query.body_a = "a";
    query.body_b = "b";
    query.pose_a.pose.orientation.w = query.pose_b.pose.orientation.w = 1.0;
  }
  QueryAnswer answerAll() { return answerQuery(query, scene, {&buffer, "world", 0.0, 1.0}, now); }
  PairNiches answer() { return answerAll().result; }
  void expectRefusal(const std::string& part) {
    const PairNiches result = answer();
    EXPECT_FALSE(isAnswered(result));
    EXPECT_EQ(result.nearest.status.code, PairStatus::INVALID_REQUEST);
    EXPECT_NE(result.nearest.status.message.find(part), std::string::npos) << result.nearest.status.message;
    EXPECT_TRUE(std::isnan(result.nearest.distance));
  }

  const ros::Time now{100, 0};
  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
  DistanceQuery query;
};

TEST_F(AnswerQuery, AnswerFromTransformsInTheReferenceFrame) {
  const PairNiches result = answer();
  ASSERT_TRUE(isAnswered(result)) << result.nearest.status.message;
  EXPECT_NEAR(result.nearest.distance, 1.0, kRounding);
  EXPECT_NEAR(result.nearest.point_a.x, 0.5, kRounding);
  EXPECT_NEAR(result.nearest.point_b.x, 1.5, kRounding);
  EXPECT_EQ(result.header.frame_id, "world");
  EXPECT_EQ(result.header.stamp, now);
  EXPECT_TRUE(result.niches.empty()) << "nobody asked for them";
}

TEST_F(AnswerQuery, AnswerWithTheBodiesInTheOrderAskedFor) {
  std::swap(query.body_a, query.body_b);
  const PairNiches result = answer();
  EXPECT_NEAR(result.nearest.point_a.x, 1.5, kRounding);
  EXPECT_EQ(result.nearest.body_a, "b");
}

TEST_F(AnswerQuery, TakePosesGivenInsteadOfTransforms) {
  query.use_pose_b = 1;
  query.pose_b.pose.position.x = 5.0;
  EXPECT_NEAR(answer().nearest.distance, 4.0, kRounding) << "in the reference frame";
  query.pose_b.header.frame_id = "b";
  EXPECT_NEAR(answer().nearest.distance, 6.0, kRounding) << "in b's own frame";
  query.pose_b.header.frame_id = "";
  query.use_pose_a = 1;
  query.pose_a.pose.position.x = -1.0;
  const PairNiches both = answer();
  EXPECT_NEAR(both.nearest.distance, 5.0, kRounding);
  EXPECT_NEAR(both.nearest.point_a.x, -0.5, kRounding);
}

TEST_F(AnswerQuery, NeedNoTransformWhenBothPosesAreGiven) {
  const TransformBuffer empty = timelessBuffer();
  query.use_pose_a = query.use_pose_b = 1;
  query.pose_b.pose.position.x = 3.0;
  const PairNiches result = answerQuery(query, scene, {&empty, "world", 0.0, 1.0}, now).result;
  ASSERT_TRUE(isAnswered(result)) << result.nearest.status.message;
  EXPECT_NEAR(result.nearest.distance, 2.0, kRounding);
}

TEST_F(AnswerQuery, TellNichesOnRequestWithoutIds) {
  query.with_niches = 1;
  const PairNiches result = answer();
  ASSERT_FALSE(result.niches.empty());
  for (const Niche& niche : result.niches) {
    EXPECT_EQ(niche.id, 0U);
  }
  EXPECT_EQ(result.nearest.nearest_niche_id, 0U);
  EXPECT_TRUE(result.changes.empty());
}

TEST_F(AnswerQuery, AnswerForBodiesThatAreNoPair) {
  query.body_a = "c";
  EXPECT_NEAR(answer().nearest.distance, 4.0, kRounding);
}

TEST_F(AnswerQuery, RefuseWhatCannotBeAnsweredAndSayWhy) {
  query.body_b = "nobody";
  expectRefusal("nobody");
  query.body_b = "a";
  expectRefusal("two different bodies");
  query.body_b = "b";
  query.use_pose_b = 1;
  query.pose_b.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  expectRefusal("pose_b.position");
  query.pose_b.pose.position.x = 0.0;
  query.pose_b.pose.orientation.w = 0.5;
  expectRefusal("pose_b.orientation");
  query.pose_b.pose.orientation.w = 1.0;
  query.accuracy = 5;
  expectRefusal("accuracy");
  query.accuracy = DistanceQuery::ACCURACY_REFINED;
  query.relative_tolerance = 0.01;
  expectRefusal("relative_tolerance");
  query.relative_tolerance = 0.0;
  query.time_budget = -0.01;
  expectRefusal("time_budget");
}

TEST_F(AnswerQuery, ProveTheDistanceWhenAsked) {
  const std::vector<std::uint8_t> levels = {DistanceQuery::ACCURACY_CERTIFIED,
                                            DistanceQuery::ACCURACY_COMPLETE};
  for (std::size_t choice = 0; choice < 4; ++choice) {
    query.accuracy = levels[choice / 2];
    query.with_niches = static_cast<std::uint8_t>(choice % 2);
    const PairDistance nearest = answer().nearest;
    EXPECT_EQ(nearest.status.code, PairStatus::OK);
    EXPECT_EQ(nearest.accuracy, PairDistance::ACCURACY_CERTIFIED);
    ASSERT_TRUE(nearest.has_lower_bound);
    EXPECT_LE(nearest.lower_bound, 1.0);
    EXPECT_GE(nearest.lower_bound, 1.0 - kRounding);
    EXPECT_GT(nearest.cost.triangle_pairs, 0U);
  }
}

TEST_F(AnswerQuery, SayWhichFrameIsMissing) {
  query.use_pose_b = 1;
  query.pose_b.header.frame_id = "atlantis";
  const PairNiches result = answer();
  EXPECT_EQ(result.nearest.status.code, PairStatus::MISSING_TRANSFORM);
  EXPECT_NE(result.nearest.status.message.find("atlantis"), std::string::npos);
  EXPECT_FALSE(isAnswered(result));
}

TEST_F(AnswerQuery, AnswerAtTheStampGiven) {
  place(buffer, "b", 4.0, now + ros::Duration(1.0));
  place(buffer, "a", 0.0, now + ros::Duration(1.0));
  query.stamp = now + ros::Duration(0.5);
  EXPECT_NEAR(answer().nearest.distance, 2.0, 1e-9) << "tf2 keeps nanoseconds";
  query.stamp = now + ros::Duration(5.0);
  EXPECT_EQ(answer().nearest.status.code, PairStatus::MISSING_TRANSFORM);
}

TEST_F(AnswerQuery, ReportOverlapAsPenetratingAtDistanceZero) {
  query.use_pose_b = 1;
  query.pose_b.pose.position.x = 0.5;
  query.pose_b.pose.position.y = 0.3;
  const PairNiches result = answer();
  EXPECT_EQ(result.nearest.status.code, PairStatus::PENETRATING);
  EXPECT_TRUE(isAnswered(result));
  EXPECT_EQ(result.nearest.distance, 0.0);
}

// Two posts around a: when b stands where a does, each is in one half of a; moved away, each is a niche.
SceneBody twoPosts(double half_distance) {
  SceneBody body = unitBox("b");
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  const Eigen::Vector3d aside = half_distance * Eigen::Vector3d::UnitX();
  BodyMeshOptions options;
  options.max_edge_length = 0.5;
  body.mesh =
      std::make_shared<const BodyMesh>("posts",
                                       test::makeJoined(test::makeCuboid(aside - half, aside + half),
                                                        test::makeCuboid(-aside - half, -aside + half)),
                                       options);
  body.bounds = boundsOf(body.mesh->surface());
  return body;
}

TEST_F(AnswerQuery, CutTheNichesToTheCountOfTheAnswer) {
  scene.bodies.edit(1) = twoPosts(2.0);
  query.with_niches = query.use_pose_b = 1;
  query.largest_niche_count = std::numeric_limits<std::uint32_t>::max();
  QueryContext context{&buffer, "world", 0.0, 1.0};
  const PairNiches whole = answerQuery(query, scene, context, now).result;
  EXPECT_EQ(whole.niches.size(), 2U);
  EXPECT_FALSE(whole.niches_cut);
  context.largest_niche_count = 1;
  const PairNiches cut = answerQuery(query, scene, context, now).result;
  EXPECT_EQ(cut.niches.size(), 1U);
  EXPECT_TRUE(cut.niches_cut);
  EXPECT_NEAR(cut.nearest.distance, 1.0, kRounding);
}

TEST_F(AnswerQuery, RefuseContactsBeyondTheCountOfTheAnswer) {
  scene.bodies.edit(1) = twoPosts(0.6);
  query.with_contacts = query.use_pose_b = 1;
  query.pose_b.pose.position.y = 0.25;
  QueryContext context{&buffer, "world", 0.0, 1.0};
  EXPECT_EQ(answerQuery(query, scene, context, now).contacts.contacts.size(), 2U);
  context.largest_niche_count = 1;
  const QueryAnswer refused = answerQuery(query, scene, context, now);
  EXPECT_TRUE(isAnswered(refused.result));
  EXPECT_TRUE(refused.contacts.contacts.empty());
  EXPECT_EQ(refused.contacts.status.code, PairStatus::MEMORY_EXHAUSTED);
  EXPECT_NE(refused.contacts.status.message.find("2 regions"), std::string::npos);
}

}  // namespace
}  // namespace concave_distance::answer_query_test
