#include "python_scene_tracker.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "signal_check.h"
#include "tracking/rigid_pose.h"

namespace concave_distance::python {

namespace py = pybind11;

PythonSceneTracker::PythonSceneTracker(ScenePointer scene, std::uint32_t threads)
    : scene_(std::move(scene)), tracker_(SceneTrackerOptions{threads, &stop_, false}) {
  const py::gil_scoped_release unlocked;
  tracker_.setScene(scene_->scene);
}

SceneAnswers PythonSceneTracker::update(const py::object& poses, double time, bool niches) {
  Cycle next{bodyPoses(readPoses(poses, "poses")), time};
  const py::gil_scoped_release unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  requireLater(time);
  PairDemand demand;
  demand.watched = demand.due = true;
  demand.niches = niches;
  cycle_ = std::move(next);
  runWatched([&] { tracker_.update(cycle_.world_from_body, time, demand); }, stop_);
  return SceneAnswers(tracker_.pairs());
}

void PythonSceneTracker::restart() {
  const py::gil_scoped_release unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  tracker_.restart();
  cycle_ = {};
}

// The tracker takes poses of the same time for the same poses.
void PythonSceneTracker::requireLater(double time) const {
  if (std::isfinite(time) && time > cycle_.time) return;
  throw Error("time", "it is " + numberText(time, 17) + " after " + numberText(cycle_.time, 17),
              "give ascending seconds, or call restart() first");
}

std::vector<std::optional<Eigen::Isometry3d>> PythonSceneTracker::bodyPoses(
    const std::vector<GivenPose>& given) const {
  const auto& bodies = scene_->scene.bodies;
  if (given.size() != bodies.size())
    throw Error(
        "poses",
        "there are " + std::to_string(given.size()) + " for " + std::to_string(bodies.size()) + " bodies",
        "give one for each of Scene.body_names, NaN where it is not known");
  std::vector<std::optional<Eigen::Isometry3d>> poses(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i].is_missing) continue;
    poses[i] = rigidPose(given[i].pose);
    if (!poses[i])
      throw Error("poses", "that of body '" + bodies[i].name + "' is no pose",
                  "give a rotation and a finite position, or NaN where it is not known");
  }
  return poses;
}

}  // namespace concave_distance::python
