#pragma once

#include <concave_distance/AddBody.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/RemoveBody.h>
#include <concave_distance/ResetTracking.h>
#include <concave_distance/SetEffects.h>
#include <concave_distance/SetPairEnabled.h>
#include <concave_distance/SetWarningDistance.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <string>

#include "concave_distance/loading/mesh_roots.h"
#include "concave_distance/loading/resource_locator.h"
#include "ros/tf/transform_buffer.h"
#include "ros/topics/scene_store.h"
#include "scene/restart_requests.h"
#include "service_queues.h"

namespace concave_distance {

/// The services that list and change the scene: list_bodies, add_body, remove_body, set_pair_enabled,
/// set_effects, set_warning_distance, reset_tracking.
class SceneServices {
 public:
  /// add_body passes the gate for long requests, the others do not.
  /// @param transforms tf, for the frames of added bodies
  SceneServices(ServiceQueues& queues, SceneStore& keeper, RestartRequests& restarts,
                const TransformBuffer& transforms, std::string reference_frame,
                PackageLocator package_locator, MeshAccess mesh_access);

 private:
  bool listBodies(ListBodies::Request& request, ListBodies::Response& response);
  bool addBody(AddBody::Request& request, AddBody::Response& response);
  bool removeBody(RemoveBody::Request& request, RemoveBody::Response& response);
  bool setPairEnabled(SetPairEnabled::Request& request, SetPairEnabled::Response& response);
  bool setEffects(SetEffects::Request& request, SetEffects::Response& response);
  bool setWarningDistance(SetWarningDistance::Request& request, SetWarningDistance::Response& response);
  bool resetTracking(ResetTracking::Request& request, ResetTracking::Response& response);
  /// @throws Error while the scene is not loaded: it would replace what is edited now
  void requireScene();

  ros::NodeHandle light_;
  ros::NodeHandle heavy_;
  RequestGate& gate_;
  SceneStore& keeper_;
  RestartRequests& restarts_;
  const TransformBuffer& transforms_;
  std::string reference_frame_;
  PackageLocator package_locator_;
  MeshAccess mesh_access_;
  ros::ServiceServer list_bodies_;
  ros::ServiceServer add_body_;
  ros::ServiceServer remove_body_;
  ros::ServiceServer set_pair_enabled_;
  ros::ServiceServer set_effects_;
  ros::ServiceServer set_warning_distance_;
  ros::ServiceServer reset_tracking_;
};

}  // namespace concave_distance
