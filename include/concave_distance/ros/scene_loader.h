#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "concave_distance/base/error.h"
#include "concave_distance/ros/node_parameters.h"
#include "concave_distance/ros/scene_loading.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Prepares the scene in a thread of its own, so that services, diagnostics and shutdown go on meanwhile.
/// One thread at a time calls it.
class SceneLoader {
 public:
  struct Outcome {
    std::optional<Scene> scene;
    std::optional<Error> error;  ///< a scene file that is wrong in itself
  };

  SceneLoader() = default;
  /// Waits for the bodies that are being prepared; those not begun are left out.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  bool isRunning() const { return thread_.joinable(); }
  void start(const NodeParameters& parameters, SceneRequest request);
  /// "prepared 12 of 54 bodies, 3.1 s"
  std::string progress() const;
  double seconds() const;
  /// Nothing while it runs.
  std::optional<Outcome> take();

 private:
  std::thread thread_;
  std::shared_ptr<LoadProgress> progress_;
  std::atomic<bool> done_{false};
  ros::WallTime start_;
  Outcome outcome_;
};

}  // namespace concave_distance
