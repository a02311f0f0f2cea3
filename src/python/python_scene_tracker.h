#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "answers.h"
#include "concave_distance/scene/scene_tracker.h"
#include "pose_arrays.h"
#include "python_scene.h"

namespace concave_distance::python {

/// Python has this as SceneTracker: usable from any thread, one at a time.
class PythonSceneTracker {
 public:
  /// Holds the input of the last cycle.
  struct Cycle {
    std::vector<std::optional<Eigen::Isometry3d>> world_from_body;  ///< empty before the first one
    double time = -std::numeric_limits<double>::infinity();         ///< seconds
  };

  PythonSceneTracker(ScenePointer scene, std::uint32_t threads);

  SceneAnswers update(const pybind11::object& poses, double time, bool niches);
  void restart();
  const ScenePointer& scene() const { return scene_; }

  /// Calls use(pairs, cycle) while no other thread runs a cycle. Without the interpreter's lock.
  template <typename Use>
  void withLastCycle(const Use& use) {
    const std::lock_guard<std::mutex> turn(mutex_);
    use(tracker_.pairs(), cycle_);
  }

 private:
  void requireLater(double time) const;
  std::vector<std::optional<Eigen::Isometry3d>> bodyPoses(const std::vector<GivenPose>& given) const;

  ScenePointer scene_;
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  SceneTracker tracker_;
  Cycle cycle_;
};

}  // namespace concave_distance::python
