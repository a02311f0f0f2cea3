#pragma once

#include <concave_distance/GetScene.h>
#include <concave_distance/Reload.h>
#include <concave_distance/SaveScene.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/tf/transform_buffer.h"
#include "ros/topics/scene_store.h"
#include "service_queues.h"

namespace concave_distance {

/// Loads the scene from the files and parameters as they are now.
struct SceneSource {
  /// Returns what they say. @param pool whose meshes the scene shares. @throws Error for what is wrong
  std::function<Scene(const std::shared_ptr<BodyPool>& pool)> load;
  /// Called with what load() returned last, when it is served.
  std::function<void(const Scene& loaded)> on_served;
};

/// The services of the whole scene: get_scene, save_scene, reload. All pass the gate for long requests.
class StateServices {
 public:
  /// @param save_folder below which scenes may be saved; empty: nowhere
  StateServices(ServiceQueues& queues, SceneStore& keeper, const TransformBuffer& transforms,
                std::string reference_frame, std::string save_folder, SceneSource source);

 private:
  bool getScene(GetScene::Request& request, GetScene::Response& response);
  bool saveScene(SaveScene::Request& request, SaveScene::Response& response);
  bool reload(Reload::Request& request, Reload::Response& response);
  /// @throws Error when a part of the scene cannot be loaded that could be before; then `response` has all
  void requireNoNewProblem(const Scene& fresh, const Scene& now, Reload::Response& response) const;

  ros::NodeHandle heavy_;
  RequestGate& gate_;
  SceneStore& keeper_;
  const TransformBuffer& transforms_;
  std::string reference_frame_;
  std::string save_folder_;
  SceneSource source_;
  std::mutex reload_mutex_;  ///< one reload at a time
  ros::ServiceServer get_scene_;
  ros::ServiceServer save_scene_;
  ros::ServiceServer reload_;
};

}  // namespace concave_distance
