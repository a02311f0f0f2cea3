#include <pybind11/stl.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "clearance_result.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/clearance.h"
#include "joint_positions.h"
#include "pose_arrays.h"
#include "python_scene.h"
#include "signal_check.h"
#include "tracking/rigid_pose.h"
#include "unlocked.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

/// Where everything is that the motion does not move.
struct Surroundings {
  py::object positions;
  py::object roots;
  py::object poses;
};

struct Options {
  ClearanceParameters parameters;
  py::object progress;
};

SceneState stateOf(const PythonScene& scene, const Surroundings& given) {
  py::object positions = given.positions;
  if (positions.is_none()) {
    const Eigen::VectorXd rest = scene.joints->restPositions();
    positions = py::array_t<double>(rest.size(), rest.data());
  }
  const JointPositions joints(scene, positions, given.roots);
  if (joints.isArray())
    throw Error("start", "there are several rows of positions",
                "give (p,): where the joints are that do not move");
  SceneState state = scene.joints->startState();
  if (!given.poses.is_none()) {
    const std::vector<GivenPose> poses = readPoses(given.poses, "bodies");
    if (poses.size() != state.world_from_body.size())
      throw Error("bodies",
                  "there are " + std::to_string(poses.size()) + " poses for " +
                      std::to_string(state.world_from_body.size()) + " bodies",
                  "give one for each of Scene.body_names, NaN where the scene has it");
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (poses[i].is_missing) continue;
      state.world_from_body[i] = rigidPose(poses[i].pose);
      if (!state.world_from_body[i])
        throw Error("bodies", "the pose of body '" + scene.scene.bodies[i].name + "' is no pose",
                    "give a rotation and a finite position, or NaN");
    }
  }
  joints.placeRoots(state);
  scene.joints->evaluate(joints.row(0), state);
  return state;
}

std::vector<double> timesOf(const py::object& times) {
  if (times.is_none()) return {};
  const DoubleArray numbers = readNumbers(times, "times");
  if (numbers.ndim() != 1) throw Error("times", "the shape is " + shapeOf(numbers), "give (w,) seconds");
  return {numbers.data(), numbers.data() + numbers.size()};
}

Eigen::MatrixXd matrixOf(const py::object& given, const std::string& where) {
  if (given.is_none()) return {};
  const DoubleArray numbers = readNumbers(given, where);
  if (numbers.ndim() != 2)
    throw Error(where, "the shape is " + shapeOf(numbers), "give (w, p): a row for each waypoint");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(numbers.data(), numbers.shape(0), numbers.shape(1));
}

PoseMotion poseMotion(const std::string& body, const py::object& poses, const py::object& times) {
  PoseMotion motion;
  motion.body = body;
  motion.times = timesOf(times);
  for (const GivenPose& given : readPoses(poses, "poses")) {
    const std::optional<Eigen::Isometry3d> pose = rigidPose(given.pose);
    if (!pose)
      throw Error("poses", "that of waypoint " + std::to_string(motion.positions.size()) + " is no pose",
                  "give a rotation and a finite position");
    motion.positions.push_back(pose->translation());
    motion.rotations.emplace_back(pose->linear());
  }
  return motion;
}

// Calls Python's function of the progress, whose exception ends the computation.
std::function<void(const ClearanceProgress&)> callOf(const py::object& progress, std::atomic<bool>& stop,
                                                     std::exception_ptr& problem) {
  if (progress.is_none()) return nullptr;
  return [function = py::handle(progress), &stop, &problem](const ClearanceProgress& now) {
    if (problem || isInterpreterEnding()) return;
    const py::gil_scoped_acquire lock;
    try {
      function(now.fraction, now.distance, now.lower_bound, now.queries);
    } catch (...) {
      problem = std::current_exception();
      stop = true;
    }
  };
}

template <typename Motion>
PythonClearance find(const PythonScene& scene, const Motion& motion, const Surroundings& surroundings,
                     Options options) {
  const SceneState state = stateOf(scene, surroundings);
  std::atomic<bool> stop = false;
  std::exception_ptr problem;
  options.parameters.stop = &stop;
  options.parameters.progress = callOf(options.progress, stop, problem);
  ClearanceResult result;
  const Unlocked unlocked;
  runWatched([&] { result = findClearance(scene.scene, *scene.joints, state, motion, options.parameters); },
             stop);
  if (problem) std::rethrow_exception(problem);
  return {scene.scene, std::move(result)};
}

constexpr const char* kOptionsDoc =
    "start: (p,) rad or m, joint positions of what the motion does not move; None: Scene.rest_positions\n"
    "roots: as of Scene.poses_of_bodies\n"
    "bodies: (b, 4, 4) or (b, 7), where bodies on no robot are in the world; NaN or None: as the scene has "
    "them\n"
    "tolerance: metres that lower_bound may stay below the distance\n"
    "threshold: metres; the first time below it is looked for\n"
    "time_budget: seconds, None: no limit; sample_limit: pairs at one time that are looked at\n"
    "each_pair: proves every pair's own least distance; niches: adds those of the nearest pair\n"
    "threads: 0 for one per core\n"
    "progress: called about ten times a second with fraction, distance, lower_bound, queries; an exception "
    "ends the computation\n"
    "Returns Clearance. Raises Error.";

}  // namespace

void bindClearance(py::module& module) {
  const ClearanceParameters defaults;
  // The arguments that both functions have, made into what find() takes.
  const auto options = [](double tolerance, std::optional<double> threshold,
                          std::optional<double> time_budget, std::uint64_t sample_limit, bool each_pair,
                          bool niches, std::uint32_t threads, const py::object& progress) {
    Options made;
    made.parameters.tolerance = tolerance;
    made.parameters.threshold = threshold;
    if (time_budget) made.parameters.time_budget = *time_budget;
    made.parameters.sample_limit = sample_limit;
    made.parameters.each_pair = each_pair;
    made.parameters.niches = niches;
    made.parameters.threads = threads;
    made.progress = progress;
    return made;
  };
  module.def(
      "find_clearance",
      [options](const PythonScene& scene, const py::object& positions, const py::object& times,
                const py::object& velocities, const py::object& accelerations,
                const std::optional<std::vector<std::string>>& joints, const py::object& start,
                const py::object& roots, const py::object& bodies, double tolerance,
                std::optional<double> threshold, std::optional<double> time_budget,
                std::uint64_t sample_limit, bool each_pair, bool niches, std::uint32_t threads,
                const py::object& progress) {
        JointMotion motion;
        motion.joints = joints.value_or(scene.joints->positionNames());
        motion.times = timesOf(times);
        motion.positions = matrixOf(positions, "positions");
        motion.velocities = matrixOf(velocities, "velocities");
        motion.accelerations = matrixOf(accelerations, "accelerations");
        return find(
            scene, motion, {start, roots, bodies},
            options(tolerance, threshold, time_budget, sample_limit, each_pair, niches, threads, progress));
      },
      py::arg("scene"), py::arg("positions"), py::arg("times") = py::none(),
      py::arg("velocities") = py::none(), py::arg("accelerations") = py::none(),
      py::arg("joints") = py::none(), py::arg("start") = py::none(), py::arg("roots") = py::none(),
      py::arg("bodies") = py::none(), py::arg("tolerance") = defaults.tolerance,
      py::arg("threshold") = py::none(), py::arg("time_budget") = py::none(),
      py::arg("sample_limit") = defaults.sample_limit, py::arg("each_pair") = false,
      py::arg("niches") = false, py::arg("threads") = 0, py::arg("progress") = py::none(),
      (std::string(
           "Finds the least distance over a motion of joints, with a proof.\n\n"
           "positions: (w, p) rad or m, a row for each waypoint; between them straight, with velocities "
           "cubic, with accelerations too quintic\n"
           "times: (w,) seconds, ascending; None: 0, 1, 2, ...\n"
           "velocities, accelerations: (w, p) or None\n"
           "joints: names of the p columns; None: Scene.position_names\n") +
       kOptionsDoc)
          .c_str());
  module.def(
      "find_clearance_of_body",
      [options](const PythonScene& scene, const std::string& body, const py::object& poses,
                const py::object& times, const py::object& start, const py::object& roots,
                const py::object& bodies, double tolerance, std::optional<double> threshold,
                std::optional<double> time_budget, std::uint64_t sample_limit, bool each_pair, bool niches,
                std::uint32_t threads, const py::object& progress) {
        return find(
            scene, poseMotion(body, poses, times), {start, roots, bodies},
            options(tolerance, threshold, time_budget, sample_limit, each_pair, niches, threads, progress));
      },
      py::arg("scene"), py::arg("body"), py::arg("poses"), py::arg("times") = py::none(),
      py::arg("start") = py::none(), py::arg("roots") = py::none(), py::arg("bodies") = py::none(),
      py::arg("tolerance") = defaults.tolerance, py::arg("threshold") = py::none(),
      py::arg("time_budget") = py::none(), py::arg("sample_limit") = defaults.sample_limit,
      py::arg("each_pair") = false, py::arg("niches") = false, py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      (std::string(
           "Finds the least distance over a motion of one body and what is attached to it, with a proof.\n\n"
           "body: its name; poses: (w, 4, 4) or (w, 7) in the world, a row for each waypoint; between them "
           "the translation runs straight and the rotation at constant speed\n"
           "times: (w,) seconds, ascending; None: 0, 1, 2, ...\n") +
       kOptionsDoc)
          .c_str());
}

}  // namespace concave_distance::python
