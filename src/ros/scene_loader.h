#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene.h"
#include "node_parameters.h"
#include "scene_loading.h"

namespace concave_distance {

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
  Outcome outcome_;
};

}  // namespace concave_distance
