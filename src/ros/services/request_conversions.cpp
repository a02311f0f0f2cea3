#include "request_conversions.h"

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"

namespace concave_distance {
namespace {

void checkFinite(double value, const std::string& where) {
  if (!std::isfinite(value)) {
    throw Error(where, "a number is " + numberText(value), "every number must be finite");
  }
}

}  // namespace

Eigen::Vector3d scaleFromMessage(const geometry_msgs::Vector3& scale) {
  const Eigen::Vector3d given(scale.x, scale.y, scale.z);
  return given.isZero(0.0) ? Eigen::Vector3d::Ones() : given;
}

Eigen::Isometry3d poseFromMessage(const geometry_msgs::Pose& pose, const std::string& where) {
  for (const double value : {pose.position.x, pose.position.y, pose.position.z}) {
    checkFinite(value, where + ".position");
    if (std::abs(value) > kLargestCoordinate) {
      TextStream seen;
      seen << "a coordinate is " << value << " m";
      throw Error(where + ".position", seen.str(), "allowed: up to 1e18 m");
    }
  }
  for (const double value :
       {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w}) {
    checkFinite(value, where + ".orientation");
  }
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  Eigen::Quaterniond rotation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (rotation.coeffs().isZero(0.0)) {
    return result;  // an orientation that was not filled in
  }
  const double norm = rotation.norm();
  if (std::abs(norm - 1.0) > kUnitTolerance) {
    throw Error(where + ".orientation", "the quaternion's norm is " + numberText(norm),
                "give a unit quaternion; no rotation is w: 1, or all zeros");
  }
  rotation.normalize();
  result.linear() = rotation.toRotationMatrix();
  return result;
}

TrackerParameters queryParameters(const DistanceQuery& query, const TrackerParameters& configured) {
  TrackerParameters parameters = configured;
  switch (query.accuracy) {
    case DistanceQuery::ACCURACY_DEFAULT:
      break;
    case DistanceQuery::ACCURACY_NODES:
      parameters.accuracy = AccuracyLevel::Nodes;
      break;
    case DistanceQuery::ACCURACY_REFINED:
      parameters.accuracy = AccuracyLevel::Refined;
      break;
    case DistanceQuery::ACCURACY_CERTIFIED:
    case DistanceQuery::ACCURACY_COMPLETE:
      parameters.accuracy = AccuracyLevel::Certified;
      break;
    default:
      throw Error("accuracy", "the value is " + std::to_string(query.accuracy), "allowed: 0, 1, 2, 3, 4");
  }
  if (query.accuracy != DistanceQuery::ACCURACY_DEFAULT) {
    parameters.absolute_tolerance = parameters.relative_tolerance = 0.0;
    parameters.time_budget = std::numeric_limits<double>::infinity();
  }
  const auto take = [&](const char* name, double value, double& parameter) {
    if (value == 0.0) {
      return;
    }
    if (!provesDistance(parameters.accuracy)) {
      throw Error(name, "the value is " + numberText(value) + ", but it belongs to levels with a proof",
                  "ask for ACCURACY_CERTIFIED, or leave it 0");
    }
    parameter = value;
  };
  take("absolute_tolerance", query.absolute_tolerance, parameters.absolute_tolerance);
  take("relative_tolerance", query.relative_tolerance, parameters.relative_tolerance);
  if (query.time_budget != 0.0) parameters.time_budget = query.time_budget;
  parameters.niches_wanted = query.with_niches != 0;
  if (query.largest_niche_count != 0) {
    parameters.largest_niche_count = query.largest_niche_count;
  }
  parameters.validate("query");
  return parameters;
}

BodyDescription toBodyDescription(const AddBodyRequest& request, const SceneDefaults& defaults) {
  if (request.mesh_resource.empty() == request.primitive.empty()) {
    throw Error("geometry",
                request.primitive.empty() ? "neither a mesh nor a primitive" : "a mesh and a primitive",
                "give mesh_resource or primitive, one of the two");
  }
  BodyDescription description;
  description.name = request.name;
  description.frame = requireFrameName(request.frame_id, "frame_id");
  description.mesh_resource = request.mesh_resource;
  description.scale = scaleFromMessage(request.scale);
  description.primitive = request.primitive;
  description.dimensions = request.dimensions;
  description.frame_from_geometry = poseFromMessage(request.pose, "pose");
  description.max_edge_length = defaults.max_edge_length;
  description.chord_error = defaults.chord_error;
  if (request.max_edge_length != 0.0) {
    description.max_edge_length = request.max_edge_length;
  }
  if (request.chord_error != 0.0) {
    description.chord_error = request.chord_error;
  }
  return description;
}

}  // namespace concave_distance
