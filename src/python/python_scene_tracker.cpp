#include "python_scene_tracker.h"

#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "signal_check.h"
#include "tracking/rigid_pose.h"
#include "unlocked.h"

namespace concave_distance::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds kShortCycle{50};

// The poses are those of the scene's bodies, in the last axis but those of a pose.
void requireBodies(const GivenPoses& given, std::size_t axes, std::size_t bodies) {
  if (given.shape.size() == axes && given.shape.back() == bodies) return;
  const std::size_t count = given.shape.empty() ? 1 : given.shape.back();
  throw Error("poses", "there are " + std::to_string(count) + " for " + std::to_string(bodies) + " bodies",
              "give one for each of Scene.body_names, NaN where it is not known");
}

PairDemand demandOf(bool niches) {
  PairDemand demand;
  demand.watched = demand.due = true;
  demand.niches = niches;
  return demand;
}

}  // namespace

PythonSceneTracker::PythonSceneTracker(ScenePointer scene, std::uint32_t threads)
    : scene_(std::move(scene)), threads_(threads), tracker_(SceneTrackerOptions{threads, &stop_, false}) {
  const Unlocked unlocked;
  tracker_.setScene(scene_->scene);
}

SceneAnswers PythonSceneTracker::update(const py::object& poses, double time, bool niches) {
  const GivenPoses given = readPoses(poses, "poses", 1);
  requireBodies(given, 1, scene_->scene.bodies.size());
  Cycle next{bodyPoses(given.poses.data()), time};
  const Unlocked unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  requireLater(time);
  cycle_ = std::move(next);
  runCycle([&] { tracker_.update(cycle_.world_from_body, time, demandOf(niches)); });
  return SceneAnswers(tracker_.pairs());
}

std::vector<NearestRow> PythonSceneTracker::nearest(const py::object& poses) {
  const GivenPoses given = readPoses(poses, "poses", 2);
  const std::size_t bodies = scene_->scene.bodies.size();
  requireBodies(given, 2, bodies);
  std::vector<NearestRow> rows(given.shape.front());
  const Unlocked unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  runWatched(
      [&] {
        if (!query_tracker_) {
          query_tracker_ = std::make_unique<SceneTracker>(SceneTrackerOptions{threads_, &stop_, false});
          query_tracker_->setScene(scene_->scene);
        }
        for (std::size_t i = 0; i < rows.size() && !stop_; ++i) {
          const auto world_from_body = bodyPoses(given.poses.data() + i * bodies);
          query_tracker_->update(world_from_body, ++query_time_, demandOf(false));
          rows[i] = nearestOf(*query_tracker_, world_from_body);
        }
      },
      stop_);
  return rows;
}

void PythonSceneTracker::restart() {
  const Unlocked unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  tracker_.restart();
  cycle_ = {};
  may_be_long_ = true;
}

void PythonSceneTracker::runCycle(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  if (may_be_long_)
    runWatched(work, stop_);
  else
    work();
  may_be_long_ = std::chrono::steady_clock::now() - begin > kShortCycle;
}

// The tracker takes poses of the same time for the same poses.
void PythonSceneTracker::requireLater(double time) const {
  if (std::isfinite(time) && time > cycle_.time) return;
  throw Error("time", "it is " + numberText(time, 17) + " after " + numberText(cycle_.time, 17),
              "give ascending seconds, or call restart() first");
}

std::vector<std::optional<Eigen::Isometry3d>> PythonSceneTracker::bodyPoses(const GivenPose* given) const {
  const auto& bodies = scene_->scene.bodies;
  std::vector<std::optional<Eigen::Isometry3d>> poses(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i, ++given) {
    if (given->is_missing) continue;
    poses[i] = rigidPose(given->pose);
    if (!poses[i])
      throw Error("poses", "that of body '" + bodies[i].name + "' is no pose",
                  "give a rotation and a finite position, or NaN where it is not known");
  }
  return poses;
}

}  // namespace concave_distance::python
