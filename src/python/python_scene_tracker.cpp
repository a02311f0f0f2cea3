#include "python_scene_tracker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "scene/name_pattern.h"
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

std::vector<bool> readMoved(const py::object& moved, std::size_t bodies) {
  if (moved.is_none()) return {};
  const auto given = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(moved);
  if (!given || given.ndim() != 1 || static_cast<std::size_t>(given.size()) != bodies)
    throw Error("moved", "it is no array of " + std::to_string(bodies) + " truth values",
                "give one for each of Scene.body_names");
  return std::vector<bool>(given.data(), given.data() + given.size());
}

Scene withoutBudgets(Scene scene) {
  const auto change = [](PairSettings& settings) {
    settings.tracker.time_budget = std::numeric_limits<double>::infinity();
  };
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) change(scene.pairs.edit(i).settings);
  for (PairSettings& settings : scene.rules.settings) change(settings);
  change(scene.defaults.pairs);
  return scene;
}

}  // namespace

PythonSceneTracker::PythonSceneTracker(ScenePointer scene, std::uint32_t threads,
                                       std::vector<std::string> pairs, bool time_budgets)
    : scene_(std::move(scene)),
      threads_(threads),
      patterns_(std::move(pairs)),
      tracker_(SceneTrackerOptions{threads, &stop_, false}) {
  for (const std::string& pattern : patterns_) detail::requirePatternLength(pattern, "pairs");
  const Unlocked unlocked;
  tracker_.setScene(time_budgets ? scene_->scene : withoutBudgets(scene_->scene));
}

bool PythonSceneTracker::isWanted(const std::string& pair) {
  if (patterns_.empty()) return true;
  const auto [place, is_new] = wanted_.try_emplace(pair, false);
  if (is_new) {
    place->second = std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& pattern) {
      return pattern == pair || detail::matchesPattern(pattern, pair);
    });
  }
  return place->second;
}

SceneAnswers PythonSceneTracker::update(const py::object& poses, double time, bool niches,
                                        const py::object& moved) {
  const GivenPoses given = readPoses(poses, "poses", 1);
  requireBodies(given, 1, scene_->scene.bodies.size());
  const std::vector<bool> due = readMoved(moved, scene_->scene.bodies.size());
  Cycle next{bodyPoses(given.poses.data()), time};
  const Unlocked unlocked;
  const std::lock_guard<std::mutex> turn(mutex_);
  requireLater(time);
  cycle_ = std::move(next);
  // A pair that waits for one of its poses goes on later.
  const auto is_due = [&](std::size_t a, std::size_t b) {
    const auto is_ready = [&](std::size_t body) { return due[body] || cycle_.world_from_body[body]; };
    return (due[a] || due[b]) && is_ready(a) && is_ready(b);
  };
  const auto demand_of = [&](std::size_t, const TrackedPair& pair) {
    if (!isWanted(pair.origin->name)) return PairDemand();
    PairDemand demand = demandOf(niches);
    demand.due = due.empty() || is_due(pair.origin->body_a, pair.origin->body_b);
    return demand;
  };
  runCycle([&] { tracker_.update(cycle_.world_from_body, time, demand_of); });
  return {tracker_, !due.empty()};
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
