#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/scene/scene.h"
#include "loading/description_search.h"
#include "node_parameters.h"

namespace concave_distance {

/// Folder of a ROS package by rospack; empty when it is not known.
std::string rosPackagePath(const std::string& package);

/// Holds what the parameter server has for a scene.
struct SceneRequest {
  std::map<std::string, std::string> descriptions;  ///< as SceneLoadOptions::descriptions
  std::map<std::string, std::string> parameters;    ///< the same texts by the names that were looked for
  std::string waiting_for;                          ///< what is not there yet; empty: the scene can be loaded
};

/// Looks for a robot's description. @param cached as the master has sent it last
std::optional<FoundDescription> findDescription(const ros::NodeHandle& node, const std::string& name,
                                                bool cached = false);

/// Reads the robot descriptions that the scene file or `~robot_description` names. Does not wait.
/// @throws Error for a wrong scene file
SceneRequest requestScene(const NodeParameters& parameters, const ros::NodeHandle& node);

/// Logs notes, warnings and problems, and how long it took. @param seconds of wall time
void logScene(const Scene& scene, double seconds);

/// Loads the scene. A robot whose URDF cannot be read becomes a problem of the scene, as does a broken mesh.
/// Takes as long as preparing the bodies; calls ROS only to find packages.
/// @throws Error for a wrong scene file
/// @param pool as SceneLoadOptions::pool
Scene loadScene(const NodeParameters& parameters, const SceneRequest& request, LoadProgress& progress,
                const std::shared_ptr<BodyPool>& pool = nullptr);

/// Prepares the scene on its own thread, so that services, diagnostics and shutdown do not wait.
/// Use it from one thread at a time.
class SceneLoader {
 public:
  struct Outcome {
    std::optional<Scene> scene;
    std::optional<Error> error;  ///< of a wrong scene file
  };

  SceneLoader() = default;
  /// Waits for bodies that are being prepared; the others are left out.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  bool isRunning() const { return thread_.joinable(); }
  /// Returns what the scene that was started last is of.
  const SceneRequest& request() const { return request_; }
  void start(const NodeParameters& parameters, SceneRequest request);
  /// Returns how far it is, such as "prepared 12 of 54 bodies, 3.1 s".
  std::string progress() const;
  double seconds() const;
  /// Returns the result and forgets it; nothing while it runs.
  std::optional<Outcome> take();

 private:
  std::thread thread_;
  std::shared_ptr<LoadProgress> progress_;
  std::atomic<bool> done_{false};
  ros::WallTime start_;
  SceneRequest request_;
  Outcome outcome_;
};

}  // namespace concave_distance
