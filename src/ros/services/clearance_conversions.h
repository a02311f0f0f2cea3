#pragma once

#include <concave_distance/ClearanceFeedback.h>
#include <concave_distance/GetClearance.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "concave_distance/kinematics/clearance.h"
#include "node_limits.h"

namespace concave_distance {

/// Reads the trajectory of a request. @param remarks gets what of it is not used, and why
/// @throws Error for points of other sizes than the list of joints, and for more than the limit
JointMotion jointMotionOf(const GetClearanceRequest& request, const NodeLimits& limits,
                          std::vector<std::string>& remarks);

/// Returns the frame that the poses of a request are in. @throws Error for two frames
std::string frameOfPoses(const GetClearanceRequest& request, const std::string& reference_frame);

/// Reads the path of poses of a request. @throws Error as poseFromMessage(), and for more than the limit
PoseMotion poseMotionOf(const GetClearanceRequest& request, const Eigen::Isometry3d& reference_from_frame,
                        const NodeLimits& limits);

/// @throws Error for a time budget beyond the limit; other ranges are those of findClearance()
ClearanceParameters clearanceParametersOf(const GetClearanceRequest& request, const NodeLimits& limits);

/// Fills in all but `success` and `message`.
void fillClearance(const Scene& scene, const ClearanceResult& result, const std::string& reference_frame,
                   GetClearanceResponse& response);

/// Adds what a reader has to know of an answer besides its numbers.
void addRemarks(const Scene& scene, const ClearanceResult& result, std::vector<std::string>& remarks);

ClearanceFeedback toFeedback(const std::string& id, const ClearanceProgress& progress, bool is_done);

}  // namespace concave_distance
