#pragma once

#include <concave_distance/AddBody.h>
#include <concave_distance/DistanceQuery.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Vector3.h>

#include <Eigen/Geometry>
#include <string>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// @throws Error (naming `where`) for a NaN or infinite number and for a quaternion whose norm differs from 1
///         by more than 1e-3; a smaller difference is normalised away
Eigen::Isometry3d poseFromMessage(const geometry_msgs::Pose& pose, const std::string& where);

/// Returns the factors of a mesh; all 0, as not filled in: ones.
Eigen::Vector3d scaleFromMessage(const geometry_msgs::Vector3& scale);

/// The pair's settings with what the query asks for instead.
/// @throws Error for a level that is none, for a tolerance or time budget that is out of range or that the
///         level has no proof for, each with the value seen
TrackerParameters queryParameters(const DistanceQuery& query, const TrackerParameters& configured);

/// @param defaults of the scene, for what the request leaves at 0
/// @throws Error for a request that names no geometry, two, or numbers out of range
BodyDescription toBodyDescription(const AddBodyRequest& request, const SceneDefaults& defaults);

}  // namespace concave_distance
