#pragma once

#include <concave_distance/AddBody.h>
#include <concave_distance/ApplyScene.h>
#include <concave_distance/RemoveBody.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "concave_distance/loading/mesh_roots.h"
#include "concave_distance/loading/resource_locator.h"
#include "ros/tf/transform_buffer.h"
#include "ros/topics/scene_store.h"
#include "scene/apply_operations.h"
#include "service_queues.h"

namespace concave_distance {

/// The services that apply operations to the scene: apply_scene, and add_body and remove_body with one each.
class OperationServices {
 public:
  /// Requests that add bodies pass the gate for long ones.
  /// @param transforms tf, for the frames of bodies
  OperationServices(ServiceQueues& queues, SceneStore& keeper, const TransformBuffer& transforms,
                    std::string reference_frame, PackageLocator package_locator, MeshAccess mesh_access);

 private:
  bool applyScene(ApplyScene::Request& request, ApplyScene::Response& response);
  bool addBody(AddBody::Request& request, AddBody::Response& response);
  bool removeBody(RemoveBody::Request& request, RemoveBody::Response& response);

  /// @throws Error when an operation is wrong; then `response` has the faults
  void applyAll(const std::vector<SceneOperation>& messages, ApplyScene::Response& response);
  std::vector<detail::SceneOperation> load(const std::vector<SceneOperation>& messages);
  void loadBodies(const std::vector<SceneOperation>& messages,
                  std::vector<detail::SceneOperation>& operations);
  struct Outcome {
    std::uint64_t revision = 0;
    detail::AppliedOperations applied;
  };
  /// Applies all, or none when there are faults. @param last called with the scene before it is served
  Outcome apply(const std::vector<detail::SceneOperation>& operations,
                const std::function<void(Scene&)>& last = {});
  std::string remarksOn(const std::vector<detail::SceneOperation>& operations,
                        const detail::AppliedOperations& applied) const;

  ros::NodeHandle light_;
  ros::NodeHandle heavy_;
  RequestGate& gate_;
  SceneStore& keeper_;
  const TransformBuffer& transforms_;
  std::string reference_frame_;
  PackageLocator package_locator_;
  MeshAccess mesh_access_;
  ros::ServiceServer apply_scene_;
  ros::ServiceServer add_body_;
  ros::ServiceServer remove_body_;
};

}  // namespace concave_distance
