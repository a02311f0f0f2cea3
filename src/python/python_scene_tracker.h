#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "answers.h"
#include "concave_distance/scene/scene_tracker.h"
#include "nearest_row.h"
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

  /// @param pairs names or patterns of those that are solved; empty: all
  /// @param time_budgets false: those of the scene's pairs do not count
  PythonSceneTracker(ScenePointer scene, std::uint32_t threads, std::vector<std::string> pairs,
                     bool time_budgets);

  /// @param moved one truth value for each body: only pairs of these are solved; None: all
  SceneAnswers update(const pybind11::object& poses, double time, bool niches, const pybind11::object& moved);
  /// The nearest pair at each of many states, beside what is tracked.
  std::vector<NearestRow> nearest(const pybind11::object& poses);
  void restart();
  const ScenePointer& scene() const { return scene_; }

  /// Calls use(pairs, cycle) while no other thread runs a cycle. Without the interpreter's lock.
  template <typename Use>
  void withLastCycle(const Use& use) {
    const std::lock_guard<std::mutex> turn(mutex_);
    use(tracker_.pairs(), cycle_);
  }

 private:
  bool isWanted(const std::string& pair);
  void requireLater(double time) const;
  /// Lets signals end a cycle that may be long: a first one, and one after a long one. Another thread for
  /// each short one would cost more than it.
  void runCycle(const std::function<void()>& work);
  /// Takes one pose for each body from here on. @throws Error naming the body
  std::vector<std::optional<Eigen::Isometry3d>> bodyPoses(const GivenPose* given) const;

  ScenePointer scene_;
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  const std::uint32_t threads_;
  const std::vector<std::string> patterns_;
  std::unordered_map<std::string, bool> wanted_;  ///< by pair, where there are patterns
  SceneTracker tracker_;
  std::unique_ptr<SceneTracker> query_tracker_;  ///< of nearest(); nullptr before the first call
  double query_time_ = 0.0;
  Cycle cycle_;
  bool may_be_long_ = true;
};

}  // namespace concave_distance::python
