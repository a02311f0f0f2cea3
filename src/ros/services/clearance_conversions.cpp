#include "clearance_conversions.h"

#include <ros/time.h>

#include <algorithm>
#include <cmath>

#include "answer_query.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "kinematics/wording.h"
#include "request_conversions.h"
#include "ros/messages/conversions.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostBodiesNamed = 8;
constexpr std::size_t kMostPairs = 1000;  // listed in an answer
constexpr double kUsualTolerance = 1e-3;  // m

void requireFewWaypoints(std::size_t count, const NodeLimits& limits) {
  if (count <= limits.largest_waypoint_count) return;
  throw Error("motion", "it has " + std::to_string(count) + " waypoints",
              "split it; ~limits/largest_waypoint_count is " + std::to_string(limits.largest_waypoint_count));
}

using TrajectoryPoint = trajectory_msgs::JointTrajectoryPoint;
using Numbers = std::vector<double> TrajectoryPoint::*;

/// Fills a row for each point. Returns false where some points, or all, have none.
bool takeNumbers(const trajectory_msgs::JointTrajectory& trajectory, Numbers numbers, const char* what,
                 Eigen::MatrixXd& rows) {
  const std::size_t columns = trajectory.joint_names.size();
  bool are_all_given = true;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const std::vector<double>& values = trajectory.points[i].*numbers;
    if (values.empty() && columns > 0) {
      are_all_given = false;
    } else if (values.size() != columns) {
      throw Error("trajectory.points[" + std::to_string(i) + "]." + what,
                  detail::counted(values.size(), "number") + " for " + detail::counted(columns, "joint"),
                  "give one for each of joint_names");
    }
  }
  if (!are_all_given) return false;
  // Only here is the matrix no larger than the request.
  rows.resize(static_cast<Eigen::Index>(trajectory.points.size()), static_cast<Eigen::Index>(columns));
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    const std::vector<double>& values = trajectory.points[static_cast<std::size_t>(row)].*numbers;
    rows.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(columns));
  }
  return true;
}

bool isAnyGiven(const trajectory_msgs::JointTrajectory& trajectory, Numbers numbers) {
  return std::any_of(trajectory.points.begin(), trajectory.points.end(),
                     [&](const TrajectoryPoint& point) { return !(point.*numbers).empty(); });
}

/// Stamps that are all zero number the waypoints.
std::vector<double> timesOrNone(std::vector<double> times) {
  const bool is_any_set = std::any_of(times.begin(), times.end(), [](double time) { return time != 0.0; });
  return is_any_set || times.size() == 1 ? times : std::vector<double>();
}

std::uint8_t codeOf(ClearanceStatus status) {
  switch (status) {
    case ClearanceStatus::Ok:
      return GetClearanceResponse::OK;
    case ClearanceStatus::Penetrating:
      return GetClearanceResponse::PENETRATING;
    case ClearanceStatus::BudgetExhausted:
      return GetClearanceResponse::BUDGET_EXHAUSTED;
    case ClearanceStatus::NoPairs:
      break;
  }
  return GetClearanceResponse::NO_PAIRS;
}

std::vector<PairBracket> toBrackets(const Scene& scene, std::vector<PairClearance> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const PairClearance& left, const PairClearance& right) {
    return left.lower_bound < right.lower_bound;
  });
  if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
  std::vector<PairBracket> brackets;
  for (const PairClearance& pair : pairs) {
    PairBracket& bracket = brackets.emplace_back();
    bracket.body_a = scene.bodies[pair.body_a].name;
    bracket.body_b = scene.bodies[pair.body_b].name;
    bracket.lower_bound = pair.lower_bound;
    bracket.has_distance = std::isnan(pair.distance) ? 0 : 1;
    bracket.distance = pair.distance;
    bracket.time = pair.time;
  }
  return brackets;
}

PairNiches toNearest(const Scene& scene, const ClearanceResult& result, const std::string& reference_frame) {
  PairHeading heading;
  heading.body_a = scene.bodies[result.body_a].name;
  heading.body_b = scene.bodies[result.body_b].name;
  const auto pair = pairOf(scene, result.body_a, result.body_b);
  heading.pair = pair ? pair->name : heading.body_a + "/" + heading.body_b;
  heading.reference_frame = reference_frame;
  heading.stamp = ros::Time::now();
  heading.reference_from_a = result.world_from_a;
  heading.accuracy = AccuracyLevel::Certified;
  heading.with_niches = true;
  PairNiches nearest = toNiches(heading, *result.solution);
  forgetIds(nearest);
  return nearest;
}

}  // namespace

JointMotion jointMotionOf(const GetClearanceRequest& request, const NodeLimits& limits,
                          std::vector<std::string>& remarks) {
  const trajectory_msgs::JointTrajectory& trajectory = request.trajectory;
  requireFewWaypoints(trajectory.points.size(), limits);
  JointMotion motion;
  motion.joints = trajectory.joint_names;
  if (trajectory.points.empty()) throw Error("trajectory", "it has no points", "give at least one");
  if (!takeNumbers(trajectory, &TrajectoryPoint::positions, "positions", motion.positions)) {
    throw Error("trajectory", "a point has no positions", "give one for each of joint_names in each point");
  }
  const bool has_velocities =
      takeNumbers(trajectory, &TrajectoryPoint::velocities, "velocities", motion.velocities) &&
      trajectory.points.size() > 1;
  const bool has_accelerations =
      takeNumbers(trajectory, &TrajectoryPoint::accelerations, "accelerations", motion.accelerations) &&
      trajectory.points.size() > 1;
  for (const TrajectoryPoint& point : trajectory.points)
    motion.times.push_back(point.time_from_start.toSec());
  motion.times = timesOrNone(std::move(motion.times));
  if (!has_velocities || motion.times.empty()) {
    motion.velocities.resize(0, 0);
    if (isAnyGiven(trajectory, &TrajectoryPoint::velocities) && trajectory.points.size() > 1) {
      remarks.push_back(std::string("velocities were not used, because ") +
                        (motion.times.empty() ? "no point has a time" : "a point has none") +
                        ": proven are straight lines between the positions");
    }
  }
  if (!has_accelerations || motion.velocities.size() == 0) {
    motion.accelerations.resize(0, 0);
    if (isAnyGiven(trajectory, &TrajectoryPoint::accelerations) && motion.velocities.size() > 0) {
      remarks.push_back("accelerations were not used, because a point has none: proven are cubics");
    }
  }
  return motion;
}

std::string frameOfPoses(const GetClearanceRequest& request, const std::string& reference_frame) {
  if (request.poses.empty()) throw Error("poses", "the list is empty", "give at least one pose of `body`");
  const std::string& first = request.poses.front().header.frame_id;
  const auto other = std::find_if(request.poses.begin(), request.poses.end(),
                                  [&](const auto& pose) { return pose.header.frame_id != first; });
  if (other != request.poses.end()) {
    throw Error("poses[" + std::to_string(other - request.poses.begin()) + "].header.frame_id",
                "it is '" + other->header.frame_id + "', that of the first '" + first + "'",
                "give all poses in one frame");
  }
  return first.empty() ? reference_frame : requireFrameName(first, "poses[0].header.frame_id");
}

PoseMotion poseMotionOf(const GetClearanceRequest& request, const Eigen::Isometry3d& reference_from_frame,
                        const NodeLimits& limits) {
  requireFewWaypoints(request.poses.size(), limits);
  PoseMotion motion;
  motion.body = request.body;
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    const geometry_msgs::PoseStamped& stamped = request.poses[i];
    const Eigen::Isometry3d pose =
        reference_from_frame * poseFromMessage(stamped.pose, "poses[" + std::to_string(i) + "]");
    motion.positions.emplace_back(pose.translation());
    motion.rotations.emplace_back(Eigen::Quaterniond(pose.linear()).normalized());
    motion.times.push_back(secondsBetween(request.poses.front().header.stamp, stamped.header.stamp));
  }
  motion.times = timesOrNone(std::move(motion.times));
  return motion;
}

ClearanceParameters clearanceParametersOf(const GetClearanceRequest& request, const NodeLimits& limits) {
  ClearanceParameters parameters;
  parameters.tolerance = request.tolerance == 0.0 ? kUsualTolerance : request.tolerance;
  if (request.with_first_time != 0) parameters.threshold = request.threshold;
  parameters.time_budget = request.time_budget == 0.0 ? limits.clearance_seconds : request.time_budget;
  if (!(parameters.time_budget <= limits.clearance_seconds)) {
    throw Error("time_budget", "the value is " + numberText(request.time_budget),
                "~limits/clearance_seconds is " + numberText(limits.clearance_seconds));
  }
  parameters.each_pair = request.each_pair != 0;
  parameters.niches = request.with_niches != 0;
  parameters.threads = 1;  // the cycle keeps the others
  return parameters;
}

void fillClearance(const Scene& scene, const ClearanceResult& result, const std::string& reference_frame,
                   GetClearanceResponse& response) {
  response.status = codeOf(result.status);
  response.has_distance = std::isnan(result.distance) ? 0 : 1;
  response.distance = result.distance;
  response.lower_bound = result.lower_bound;
  response.time = result.time;
  response.frame = reference_frame;
  response.point_a = toPoint(result.point_a);
  response.point_b = toPoint(result.point_b);
  if (response.has_distance != 0) {
    response.body_a = scene.bodies[result.body_a].name;
    response.body_b = scene.bodies[result.body_b].name;
  }
  response.first_time = response.proven_until = kNotComputed;
  if (result.first_below) {
    response.proven_until = result.first_below->proven_until;
    response.first_time = result.first_below->time;
    response.has_first_time = std::isnan(result.first_below->time) ? 0 : 1;
  }
  if (response.has_first_time != 0) {
    response.first_body_a = scene.bodies[result.first_below->body_a].name;
    response.first_body_b = scene.bodies[result.first_below->body_b].name;
  }
  if (result.solution) response.nearest = toNearest(scene, result, reference_frame);
  response.pairs = toBrackets(scene, result.pairs);
  response.queries = result.queries;
  response.seconds = result.seconds;
}

void addRemarks(const Scene& scene, const ClearanceResult& result, std::vector<std::string>& remarks) {
  if (!result.not_located.empty()) {
    std::vector<std::string> names;
    for (const std::size_t body : result.not_located) names.push_back(scene.bodies[body].name);
    remarks.push_back("nothing is proven of pairs with " + detail::listed(names, kMostBodiesNamed) +
                      ": tf does not know where they are");
  }
  if (!result.outside_limits.empty()) {
    remarks.push_back("the motion leaves the range that the URDF gives to " +
                      detail::listed(result.outside_limits, kMostBodiesNamed));
  }
  if (result.velocities_ignored) {
    remarks.push_back("velocities of floating joints were not used: proven are straight lines and slerps");
  }
  if (result.status == ClearanceStatus::NoPairs && result.not_located.empty()) {
    remarks.push_back("no watched pair has a joint of the motion between its bodies");
  }
}

ClearanceFeedback toFeedback(const std::string& id, const ClearanceProgress& progress, bool is_done) {
  ClearanceFeedback feedback;
  feedback.header.stamp = ros::Time::now();
  feedback.id = id;
  feedback.fraction = progress.fraction;
  feedback.has_distance = std::isfinite(progress.distance) ? 1 : 0;
  feedback.distance = progress.distance;
  feedback.lower_bound = progress.lower_bound;
  feedback.queries = progress.queries;
  feedback.is_done = is_done ? 1 : 0;
  return feedback;
}

}  // namespace concave_distance
