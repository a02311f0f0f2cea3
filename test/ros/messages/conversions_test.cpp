#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "concave_distance/base/error.h"
#include "ros/services/request_conversions.h"

namespace concave_distance::conversions_test {
namespace {

geometry_msgs::Pose unitPose() {
  geometry_msgs::Pose pose;
  pose.orientation.w = 1.0;
  return pose;
}

std::string refusalOf(const geometry_msgs::Pose& pose) {
  try {
    poseFromMessage(pose, "pose_a");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

PairHeading quarterTurnHeading() {
  PairHeading heading;
  heading.pair = "a/b";
  heading.body_a = "a";
  heading.body_b = "b";
  heading.reference_frame = "world";
  heading.stamp = ros::Time(12, 5);
  heading.reference_from_a =
      Eigen::Translation3d(10.0, 0.0, 0.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  heading.with_niches = true;
  return heading;
}

PairSolution solutionWithOneNiche() {
  PairSolution solution;
  solution.distance = 2.0;
  solution.point_a_in_a = Eigen::Vector3d(1.0, 0.0, 0.0);
  solution.point_b_in_a = Eigen::Vector3d(3.0, 0.0, 0.0);
  TrackedNiche niche;
  niche.id = 7;
  niche.distance = 2.0;
  niche.point_a_in_a = solution.point_a_in_a;
  niche.point_b_in_a = solution.point_b_in_a;
  niche.normal_in_a = Eigen::Vector3d::UnitX();
  niche.closing_speed = 0.25;
  niche.prominence = std::numeric_limits<double>::infinity();
  solution.niches.push_back(niche);
  solution.events.push_back({NicheEvent::Kind::Merge, 8, 7});
  solution.events.push_back({NicheEvent::Kind::Death, 9, 0});
  solution.normal_in_a = solution.niches.front().normal_in_a;
  solution.closing_speed = solution.niches.front().closing_speed;
  return solution;
}

TEST(PoseFromMessage, NormalisesRoundingAndRefusesTheRest) {
  geometry_msgs::Pose pose = unitPose();
  pose.position.y = 2.0;
  pose.orientation.w = 1.0005;
  EXPECT_NEAR((poseFromMessage(pose, "p").linear() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-15);
  EXPECT_EQ(poseFromMessage(pose, "p").translation().y(), 2.0);
  pose.orientation.w = 1.01;
  EXPECT_NE(refusalOf(pose).find("pose_a.orientation"), std::string::npos);
  EXPECT_NE(refusalOf(pose).find("1.01"), std::string::npos);
  pose.orientation.w = 0.5;
  EXPECT_NE(refusalOf(pose).find("w: 1"), std::string::npos) << "the message tells the remedy";
  pose = unitPose();
  pose.position.z = std::nan("");
  EXPECT_NE(refusalOf(pose).find("finite"), std::string::npos);
  pose = unitPose();
  pose.orientation.x = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusalOf(pose), "");
}

TEST(PoseFromMessage, AnOrientationOfZerosIsNoRotation) {
  geometry_msgs::Pose pose;
  pose.position.x = 3.0;
  const Eigen::Isometry3d read = poseFromMessage(pose, "p");
  EXPECT_EQ(read.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(read.translation(), Eigen::Vector3d(3.0, 0.0, 0.0));
  pose.orientation.x = 1e-9;
  EXPECT_NE(refusalOf(pose), "") << "not all of it is zero";
}

TEST(ToDistance, GivesPointsInTheReferenceFrameAtTheDistanceStated) {
  const PairDistance message = toDistance(quarterTurnHeading(), solutionWithOneNiche());
  EXPECT_EQ(message.header.frame_id, "world");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 5));
  EXPECT_EQ(message.status.code, PairStatus::OK);
  ASSERT_TRUE(message.has_distance && message.has_points);
  EXPECT_NEAR(message.point_a.x, 10.0, 1e-12);
  EXPECT_NEAR(message.point_a.y, 1.0, 1e-12);
  EXPECT_NEAR(message.point_b.y, 3.0, 1e-12);
  EXPECT_NEAR(message.normal.y, 1.0, 1e-12);
  EXPECT_TRUE(message.has_closing_speed);
  EXPECT_EQ(message.closing_speed, 0.25);
  EXPECT_EQ(message.nearest_niche_id, 7U);
  EXPECT_FALSE(message.has_lower_bound);
  EXPECT_TRUE(std::isnan(message.lower_bound));
}

TEST(ToDistance, CarriesNoNumberWithoutItsFlag) {
  PairSolution solution;
  solution.status = SolveStatus::InvalidPose;
  const PairDistance invalid = toDistance(quarterTurnHeading(), solution);
  EXPECT_EQ(invalid.status.code, PairStatus::INVALID_POSE);
  EXPECT_FALSE(invalid.status.message.empty());
  EXPECT_FALSE(invalid.has_distance || invalid.has_points || invalid.has_lower_bound ||
               invalid.has_closing_speed);
  EXPECT_TRUE(std::isnan(invalid.distance) && std::isnan(invalid.point_a.x) && std::isnan(invalid.normal.z));

  solution.status = SolveStatus::Ok;
  const PairDistance nothing = toDistance(quarterTurnHeading(), solution);
  EXPECT_EQ(nothing.status.code, PairStatus::NOT_FOUND) << "no distance without a status that says so";

  solution = solutionWithOneNiche();
  solution.closing_speed = kNotComputed;
  EXPECT_FALSE(toDistance(quarterTurnHeading(), solution).has_closing_speed);
}

TEST(ToNiches, ReportsNichesAndChangesByTheirIds) {
  const PairHeading heading = quarterTurnHeading();
  const PairNiches message = toNiches(heading, solutionWithOneNiche());
  ASSERT_EQ(message.niches.size(), 1U);
  EXPECT_EQ(message.niches[0].id, 7U);
  EXPECT_EQ(message.nearest.nearest_niche_id, 7U);
  EXPECT_TRUE(message.niches[0].has_prominence);
  ASSERT_EQ(message.changes.size(), 2U);
  EXPECT_EQ(message.changes[0].kind, NicheChange::MERGE);
  EXPECT_EQ(message.changes[0].id, 8U);
  EXPECT_EQ(message.changes[0].into_id, 7U);
  EXPECT_EQ(message.changes[1].into_id, 0U);
}

TEST(ToNiches, CarriesKindAndExtentOfWeakMinima) {
  PairSolution solution = solutionWithOneNiche();
  solution.niches.front().kind = NicheKind::Segment;
  solution.niches.front().extent = 0.25;
  const PairNiches message = toNiches(quarterTurnHeading(), solution);
  ASSERT_EQ(message.niches.size(), 1U);
  EXPECT_EQ(message.niches[0].kind, Niche::KIND_SEGMENT);
  EXPECT_EQ(message.niches[0].extent, 0.25);
}

TEST(ToNiches, TellsNoNichesThatWereNotAskedFor) {
  PairHeading heading = quarterTurnHeading();
  heading.with_niches = false;
  const PairNiches message = toNiches(heading, solutionWithOneNiche());
  EXPECT_TRUE(message.niches.empty() && message.changes.empty());
  EXPECT_EQ(message.nearest.nearest_niche_id, 0U);
  EXPECT_TRUE(message.nearest.has_distance);
}

TEST(ToDistance, TellsTheProofAndWhatMeets) {
  PairSolution solution = solutionWithOneNiche();
  solution.accuracy = AccuracyLevel::Certified;
  solution.lower_bound = 1.5;
  solution.status = SolveStatus::WithinTolerance;
  solution.proof_cost = {100, 20, 30};
  solution.cost.evaluations = 7;
  solution.cost.generations = 1;
  solution.cost.inherited = 2;
  solution.cost.children = 3;
  solution.solve_seconds = 1e-3;
  PairDistance message = toDistance(quarterTurnHeading(), solution);
  EXPECT_EQ(message.status.code, PairStatus::WITHIN_TOLERANCE);
  EXPECT_EQ(message.accuracy, PairDistance::ACCURACY_CERTIFIED);
  EXPECT_TRUE(message.has_lower_bound);
  EXPECT_EQ(message.lower_bound, 1.5);
  EXPECT_EQ(message.cost.box_bounds, 100U);
  EXPECT_EQ(message.cost.triangle_pairs, 30U);
  EXPECT_EQ(message.cost.evaluations, 7U);
  EXPECT_EQ(message.cost.generations, 1U);
  EXPECT_EQ(message.cost.inherited, 2U);
  EXPECT_EQ(message.cost.children, 3U);
  EXPECT_EQ(message.cost.solve_time, 1e-3);
  EXPECT_FALSE(message.has_meeting_triangles || message.has_surface_distance);

  solution.status = SolveStatus::BudgetExhausted;
  solution.accuracy = AccuracyLevel::Refined;
  message = toDistance(quarterTurnHeading(), solution);
  EXPECT_EQ(message.status.code, PairStatus::BUDGET_EXHAUSTED);
  EXPECT_EQ(message.accuracy, PairDistance::ACCURACY_REFINED) << "as far as it came";

  solution.status = SolveStatus::MemoryExhausted;
  EXPECT_EQ(toDistance(quarterTurnHeading(), solution).status.code, PairStatus::MEMORY_EXHAUSTED);

  solution.status = SolveStatus::Penetrating;
  solution.meeting_triangles = TrianglePair{TriangleIndex{3U}, TriangleIndex{5U}};
  message = toDistance(quarterTurnHeading(), solution);
  EXPECT_TRUE(message.has_meeting_triangles);
  EXPECT_EQ(message.triangle_a, 3U);
  EXPECT_EQ(message.triangle_b, 5U);
}

TEST(ToNiches, CarriesTheSignedDistanceWhereOnlyMarginsOverlap) {
  PairSolution solution = solutionWithOneNiche();
  solution.status = SolveStatus::Penetrating;
  solution.distance = solution.niches[0].distance = 0.0;
  solution.signed_distance = solution.niches[0].signed_distance = -0.25;
  PairNiches message = toNiches(quarterTurnHeading(), solution);
  EXPECT_TRUE(message.nearest.has_signed_distance && message.niches[0].has_signed_distance);
  EXPECT_EQ(message.nearest.signed_distance, -0.25);
  EXPECT_EQ(message.niches[0].signed_distance, -0.25);
  solution.signed_distance = solution.niches[0].signed_distance = kNotComputed;
  message = toNiches(quarterTurnHeading(), solution);
  EXPECT_FALSE(message.nearest.has_signed_distance || message.niches[0].has_signed_distance);
  EXPECT_TRUE(std::isnan(message.nearest.signed_distance) && std::isnan(message.niches[0].signed_distance));
}

TEST(ToNiches, CarriesTheSignedPlaceInTheReferenceFrame) {
  PairSolution solution = solutionWithOneNiche();
  EXPECT_EQ(toNiches(quarterTurnHeading(), solution).niches[0].signed_state, Niche::SIGNED_NOT_ASKED);
  SignedPlace& place = solution.niches[0].signed_place;
  place.state = SignedState::Known;
  place.point_a_in_a = place.pivot_in_a = {1.0, 2.0, 3.0};
  place.point_b_in_a = {1.5, 2.0, 3.0};
  place.gradient_in_a = {-1.0, 0.0, 0.0};
  place.since_cycle = 7;
  const PairHeading heading = quarterTurnHeading();
  const Niche message = toNiches(heading, solution).niches[0];
  EXPECT_EQ(message.signed_state, Niche::SIGNED_KNOWN);
  const Eigen::Vector3d pivot = heading.reference_from_a * place.pivot_in_a;
  const Eigen::Vector3d point_b = heading.reference_from_a * place.point_b_in_a;
  const Eigen::Vector3d gradient = heading.reference_from_a.linear() * place.gradient_in_a;
  EXPECT_EQ(message.signed_pivot.x, pivot.x());
  EXPECT_EQ(message.signed_point_a.y, pivot.y());
  EXPECT_EQ(message.signed_point_b.z, point_b.z());
  EXPECT_EQ(message.signed_gradient.y, gradient.y());
  EXPECT_EQ(message.signed_since_cycle, 7U);
}

TEST(QueryParameters, TakeTheQuerysWishesAndRefuseWhatMeansNothing) {
  TrackerParameters configured;
  configured.largest_niche_count = 5;
  DistanceQuery query;
  EXPECT_EQ(queryParameters(query, configured).accuracy, configured.accuracy);
  EXPECT_EQ(queryParameters(query, configured).largest_niche_count, 5U);
  EXPECT_FALSE(queryParameters(query, configured).niches_wanted);
  query.accuracy = DistanceQuery::ACCURACY_NODES;
  query.with_niches = 1;
  query.largest_niche_count = 2;
  EXPECT_EQ(queryParameters(query, configured).accuracy, AccuracyLevel::Nodes);
  EXPECT_EQ(queryParameters(query, configured).largest_niche_count, 2U);
  EXPECT_TRUE(queryParameters(query, configured).niches_wanted);
  for (const std::uint8_t accuracy : std::vector<std::uint8_t>{5, 9}) {
    query.accuracy = accuracy;
    EXPECT_THROW(queryParameters(query, configured), Error) << static_cast<int>(accuracy);
  }
  query = DistanceQuery();
  query.time_budget = 0.25;
  query.accuracy = DistanceQuery::ACCURACY_REFINED;
  EXPECT_EQ(queryParameters(query, configured).time_budget, 0.25) << "of every level";
  query.time_budget = -1.0;
  EXPECT_THROW(queryParameters(query, configured), Error);
  for (double DistanceQuery::*field :
       {&DistanceQuery::absolute_tolerance, &DistanceQuery::relative_tolerance}) {
    query = DistanceQuery();
    query.*field = 1e-3;
    query.accuracy = DistanceQuery::ACCURACY_REFINED;
    EXPECT_THROW(queryParameters(query, configured), Error);
    query.accuracy = DistanceQuery::ACCURACY_CERTIFIED;
    EXPECT_EQ(queryParameters(query, configured).accuracy, AccuracyLevel::Certified);
    for (const double wrong : {std::nan(""), -1.0}) {
      query.*field = wrong;
      EXPECT_THROW(queryParameters(query, configured), Error);
    }
  }
}

TEST(QueryParameters, KeepTheConfiguredTolerancesUnlessALevelIsAskedFor) {
  TrackerParameters configured;
  configured.accuracy = AccuracyLevel::Certified;
  configured.relative_tolerance = 0.1;
  configured.time_budget = 0.5;
  DistanceQuery query;
  EXPECT_EQ(queryParameters(query, configured).relative_tolerance, 0.1);
  query.absolute_tolerance = 0.01;
  EXPECT_EQ(queryParameters(query, configured).absolute_tolerance, 0.01);
  EXPECT_EQ(queryParameters(query, configured).time_budget, 0.5);
  query.accuracy = DistanceQuery::ACCURACY_CERTIFIED;
  EXPECT_EQ(queryParameters(query, configured).relative_tolerance, 0.0) << "as the query says";
  EXPECT_TRUE(std::isinf(queryParameters(query, configured).time_budget));
}

TEST(ToBodyDescription, WantsOneGeometryAndAFrame) {
  AddBodyRequest request;
  request.name = "cup";
  request.frame_id = "/gripper";
  request.pose = unitPose();
  request.primitive = "sphere";
  request.dimensions = {0.1};
  const BodyDescription description = toBodyDescription(request, {});
  EXPECT_EQ(description.frame, "gripper");
  EXPECT_EQ(description.scale, Eigen::Vector3d::Ones()) << "0 0 0 counts as not given";
  EXPECT_FALSE(description.max_edge_length.has_value());
  SceneDefaults defaults;
  defaults.max_edge_length = 0.5;
  defaults.chord_error = 0.25;
  EXPECT_EQ(toBodyDescription(request, defaults).max_edge_length, 0.5);
  EXPECT_EQ(toBodyDescription(request, defaults).chord_error, 0.25);
  request.max_edge_length = 0.125;
  EXPECT_EQ(toBodyDescription(request, defaults).max_edge_length, 0.125);
  request.mesh_resource = "cup.stl";
  EXPECT_THROW(toBodyDescription(request, {}), Error);
  request.primitive.clear();
  request.scale.x = request.scale.y = request.scale.z = 0.001;
  EXPECT_EQ(toBodyDescription(request, {}).scale.x(), 0.001);
  request.mesh_resource.clear();
  EXPECT_THROW(toBodyDescription(request, {}), Error);
  request.primitive = "box";
  request.frame_id.clear();
  EXPECT_THROW(toBodyDescription(request, {}), Error);
}

TEST(HasDistance, IsTrueOfEveryStatusThatASolveReachesWithADistance) {
  PairSolution solution;
  solution.distance = 1.0;
  for (const SolveStatus status : {SolveStatus::Ok, SolveStatus::Penetrating, SolveStatus::BudgetExhausted,
                                   SolveStatus::WithinTolerance, SolveStatus::MemoryExhausted}) {
    solution.status = status;
    EXPECT_TRUE(hasDistance(toDistance(PairHeading(), solution).status)) << toString(status);
  }
  solution.distance = kNotComputed;
  for (const SolveStatus status : {SolveStatus::Ok, SolveStatus::InvalidPose}) {
    solution.status = status;
    EXPECT_FALSE(hasDistance(toDistance(PairHeading(), solution).status)) << toString(status);
  }
}

}  // namespace
}  // namespace concave_distance::conversions_test
