#pragma once

#include <concave_distance/ListBodies.h>
#include <concave_distance/ResetTracking.h>
#include <concave_distance/SetEffects.h>
#include <concave_distance/SetPairEnabled.h>
#include <concave_distance/SetWarningDistance.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <string>

#include "ros/topics/scene_store.h"
#include "scene/restart_requests.h"
#include "service_queues.h"

namespace concave_distance {

/// The services that list the bodies and change pairs: list_bodies, set_pair_enabled, set_effects,
/// set_warning_distance, reset_tracking.
class SceneServices {
 public:
  SceneServices(ServiceQueues& queues, SceneStore& keeper, RestartRequests& restarts,
                std::string reference_frame);

 private:
  bool listBodies(ListBodies::Request& request, ListBodies::Response& response);
  bool setPairEnabled(SetPairEnabled::Request& request, SetPairEnabled::Response& response);
  bool setEffects(SetEffects::Request& request, SetEffects::Response& response);
  bool setWarningDistance(SetWarningDistance::Request& request, SetWarningDistance::Response& response);
  bool resetTracking(ResetTracking::Request& request, ResetTracking::Response& response);

  ros::NodeHandle light_;
  SceneStore& keeper_;
  RestartRequests& restarts_;
  std::string reference_frame_;
  ros::ServiceServer list_bodies_;
  ros::ServiceServer set_pair_enabled_;
  ros::ServiceServer set_effects_;
  ros::ServiceServer set_warning_distance_;
  ros::ServiceServer reset_tracking_;
};

}  // namespace concave_distance
