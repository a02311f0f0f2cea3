#pragma once

#include <concave_distance/BodyInfo.h>
#include <concave_distance/PairDistance.h>
#include <concave_distance/PairInfo.h>
#include <concave_distance/PairNiches.h>
#include <concave_distance/PairStatus.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Wrench.h>

#include <Eigen/Geometry>
#include <string>

#include "concave_distance/contact/wrench.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/tracking/pair_solution.h"
#include "ros/tf/tf_poses.h"

namespace concave_distance {

geometry_msgs::Point toPoint(const Eigen::Vector3d& point);
geometry_msgs::Vector3 toVector(const Eigen::Vector3d& vector);
geometry_msgs::Quaternion toQuaternion(const Eigen::Quaterniond& rotation);
geometry_msgs::Pose toPose(const Eigen::Isometry3d& pose);
geometry_msgs::Wrench toWrench(const Wrench& wrench);

PairStatus toStatus(SolveStatus status);
PairStatus toStatus(TransformStatus status, const std::string& message);
/// True for the codes that come with a distance.
bool hasDistance(const PairStatus& status);
std::uint8_t toAccuracyCode(AccuracyLevel level);

/// Everything about a pair that its solution does not hold.
struct PairHeading {
  std::string pair;
  std::string body_a;
  std::string body_b;
  std::string reference_frame;
  ros::Time stamp;
  Eigen::Isometry3d reference_from_a = Eigen::Isometry3d::Identity();
  AccuracyLevel accuracy = AccuracyLevel::Refined;
  bool warning = false;
  bool with_niches = false;  ///< false: the niches were not asked for and are not reported
};

/// A message about a pair with nothing but its heading and status.
template <typename Message>
Message headedMessage(const PairHeading& heading, const PairStatus& status) {
  Message message;
  message.header.stamp = heading.stamp;
  message.header.frame_id = heading.reference_frame;
  message.pair = heading.pair;
  message.body_a = heading.body_a;
  message.body_b = heading.body_b;
  message.status = status;
  return message;
}

/// A pair without a distance: every number NaN, every has_ flag false.
PairDistance emptyDistance(const PairHeading& heading, const PairStatus& status);
/// The solution in the reference frame.
PairDistance toDistance(const PairHeading& heading, const PairSolution& solution);
PairNiches emptyNiches(const PairHeading& heading, const PairStatus& status);
PairNiches toNiches(const PairHeading& heading, const PairSolution& solution);

BodyInfo toBodyInfo(const SceneBody& body);
PairInfo toPairInfo(const Scene& scene, const ScenePair& pair);

}  // namespace concave_distance
