#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers.h"
#include "base/number_text.h"
#include "bindings.h"
#include "concave_distance/base/error.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "parameter_arguments.h"
#include "pose_arrays.h"
#include "text.h"
#include "tracking/rigid_pose.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

/// What Python has as Scene: immutable.
struct PythonScene {
  explicit PythonScene(Scene loaded) : scene(std::move(loaded)), joints(scene) {}

  Scene scene;
  SceneKinematics joints;
};
using ScenePointer = std::shared_ptr<PythonScene>;

using Texts = std::vector<std::string>;

std::string readText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(path, "the file cannot be read", "check its path and permissions");
  return text;
}

SceneLoadOptions loadOptions(const Texts& package_folders, const Texts& mesh_folders, bool strict,
                             const std::string& cache, const std::string& where, const py::kwargs& keywords) {
  SceneLoadOptions options;
  if (!package_folders.empty()) options.package_locator = packagesBelow(package_folders);
  options.mesh_search_path = mesh_folders;
  options.strict = strict;
  options.cache = openPreparationCache(cache);
  setParameters(keywords, Keywords::OfScene, where, options.default_settings.tracker);
  return options;
}

ScenePointer loadSceneOf(const std::string& path, const Texts& package_folders, const Texts& mesh_folders,
                         bool strict, const std::string& cache,
                         const std::map<std::string, std::string>& descriptions, const py::kwargs& keywords) {
  SceneLoadOptions options =
      loadOptions(package_folders, mesh_folders, strict, cache, "load_scene", keywords);
  options.descriptions = descriptions;
  const py::gil_scoped_release unlocked;
  return std::make_shared<PythonScene>(loadSceneFile(path, options));
}

ScenePointer loadRobotOf(const std::string& urdf, const std::optional<std::string>& srdf,
                         const Texts& package_folders, const Texts& mesh_folders, bool strict,
                         const std::string& cache, const py::kwargs& keywords) {
  SceneLoadOptions options =
      loadOptions(package_folders, mesh_folders, strict, cache, "load_robot", keywords);
  options.mesh_search_path.push_back(urdf);
  const py::gil_scoped_release unlocked;
  if (srdf) options.descriptions["robot_description_semantic"] = readText(*srdf);
  return std::make_shared<PythonScene>(loadRobotScene(readText(urdf), urdf, options));
}

Texts bodyNames(const PythonScene& scene) {
  Texts names;
  for (const SceneBody& body : scene.scene.bodies) names.push_back(body.name);
  return names;
}

py::list problemsOf(const PythonScene& scene) {
  py::list problems;
  for (const SceneProblem& problem : scene.scene.problems)
    problems.append(py::make_tuple(toPython(problem.where), toPython(problem.message)));
  return problems;
}

py::array_t<double> posesOf(const PythonScene& scene, const py::object& positions) {
  const DoubleArray given = readNumbers(positions, "positions");
  const std::size_t width = scene.joints.positionNames().size();
  const py::ssize_t axes = given.ndim();
  if (axes < 1 || axes > 2 || static_cast<std::size_t>(given.shape(axes - 1)) != width)
    throw Error("positions", "its last axis has not " + std::to_string(width) + " numbers",
                "give (p,) or (n, p), in the order of Scene.position_names");
  const std::size_t count = axes == 1 ? 1 : static_cast<std::size_t>(given.shape(0));
  const std::size_t bodies = scene.joints.bodyCount();
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(bodies), 4, 4};
  if (axes == 2) shape.insert(shape.begin(), static_cast<py::ssize_t>(count));
  py::array_t<double> poses(shape);
  double* at = poses.mutable_data();
  const double* row = given.data();
  const py::gil_scoped_release unlocked;
  SceneState state = scene.joints.startState();
  for (std::size_t i = 0; i < count; ++i, row += width) {
    scene.joints.evaluate(Eigen::Map<const Eigen::VectorXd>(row, static_cast<Eigen::Index>(width)), state);
    for (const std::optional<Eigen::Isometry3d>& pose : state.world_from_body) {
      if (pose)
        writeMatrix(*pose, at);
      else
        std::fill_n(at, 16, kNotComputed);
      at += 16;
    }
  }
  return poses;
}

/// What Python has as SceneTracker: usable from any thread, one at a time.
class PythonSceneTracker {
 public:
  PythonSceneTracker(ScenePointer scene, std::uint32_t threads)
      : scene_(std::move(scene)), tracker_(SceneTrackerOptions{threads, nullptr, false}) {
    const py::gil_scoped_release unlocked;
    tracker_.setScene(scene_->scene);
  }

  SceneAnswers update(const py::object& poses, double time, bool niches) {
    const std::vector<std::optional<Eigen::Isometry3d>> world_from_body =
        bodyPoses(readPoses(poses, "poses"));
    const py::gil_scoped_release unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    requireLater(time);
    PairDemand demand;
    demand.watched = demand.due = true;
    demand.niches = niches;
    tracker_.update(world_from_body, time, demand);
    last_time_ = time;
    return SceneAnswers(tracker_.pairs());
  }
  void restart() {
    const py::gil_scoped_release unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    tracker_.restart();
    last_time_ = -std::numeric_limits<double>::infinity();
  }
  ScenePointer scene() const { return scene_; }

 private:
  // The tracker takes poses of the same time for the same poses.
  void requireLater(double time) const {
    if (std::isfinite(time) && time > last_time_) return;
    throw Error("time", "it is " + numberText(time, 17) + " after " + numberText(last_time_, 17),
                "give ascending seconds, or call restart() first");
  }
  std::vector<std::optional<Eigen::Isometry3d>> bodyPoses(const std::vector<GivenPose>& given) const {
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

  ScenePointer scene_;
  std::mutex mutex_;
  SceneTracker tracker_;
  double last_time_ = -std::numeric_limits<double>::infinity();
};

constexpr const char* kLoadingDoc =
    "package_folders: where package:// is looked for first; after that as ROS does\n"
    "mesh_folders: searched for meshes that are not where the file says\n"
    "strict: the first thing that cannot be loaded raises Error; else it is in Scene.problems\n"
    "cache: folder that keeps what was prepared, '' for the user's, 'off' for none\n"
    "Further keywords: defaults of the pairs, as parameters() without margins and niches_wanted.\n"
    "Raises Error naming file, line and key.";

void bindLoading(py::module_& module) {
  module.def(
      "load_scene", &loadSceneOf, py::arg("path"), py::kw_only(), py::arg("package_folders") = Texts(),
      py::arg("mesh_folders") = Texts(), py::arg("strict") = false, py::arg("cache") = "",
      py::arg("descriptions") = std::map<std::string, std::string>(),
      (std::string("Loads a scene file.\n\ndescriptions: URDF texts by the names that the file has\n") +
       kLoadingDoc)
          .c_str());
  module.def("load_robot", &loadRobotOf, py::arg("urdf"), py::arg("srdf") = py::none(), py::kw_only(),
             py::arg("package_folders") = Texts(), py::arg("mesh_folders") = Texts(),
             py::arg("strict") = false, py::arg("cache") = "",
             (std::string("Loads a robot: every link a body, every two links a pair but adjacent ones.\n\n"
                          "urdf: path of the file; srdf: of one that disables pairs\n") +
              kLoadingDoc)
                 .c_str());
}

}  // namespace

void bindScenes(py::module_& module) {
  bindLoading(module);
  py::class_<PythonScene, ScenePointer>(module, "Scene", "Bodies, pairs and robots; immutable.")
      .def_property_readonly("body_names", &bodyNames)
      .def_property_readonly("problems", &problemsOf,
                             "A list of (where, message): what could not be loaded; the rest is served.")
      .def_property_readonly("warnings", [](const PythonScene& scene) { return scene.scene.warnings; })
      .def_property_readonly("notes", [](const PythonScene& scene) { return scene.scene.notes; })
      .def_property_readonly(
          "position_names", [](const PythonScene& scene) { return scene.joints.positionNames(); },
          "Names of the joint positions of all robots, p of them.")
      .def_property_readonly(
          "rest_positions", [](const PythonScene& scene) { return scene.joints.restPositions(); },
          "(p,) rad or m: zero, or the middle of a range without zero.")
      .def("poses_of_bodies", &posesOf, py::arg("positions"),
           "Where the bodies are for joint positions, the roots of robots at the origin of the world.\n\n"
           "positions: (p,) or (n, p), rad or m, in the order of position_names\n"
           "Returns (b, 4, 4) or (n, b, 4, 4), NaN for a body whose pose in the world is not known. Raises "
           "Error.");
  py::class_<PythonSceneTracker>(
      module, "SceneTracker",
      "A scene over time: finds the near pairs and solves them in parallel. It may be used "
      "from any thread; calls wait for each other.")
      .def(py::init<ScenePointer, std::uint32_t>(), py::arg("scene"), py::arg("threads") = 0,
           "threads: that solve pairs; 0: one per core.")
      .def("update", &PythonSceneTracker::update, py::arg("poses"), py::arg("time"), py::kw_only(),
           py::arg("niches_wanted") = true,
           "One cycle.\n\n"
           "poses: of the bodies in the world, (b, 4, 4) or (b, 7) with x, y, z, qx, qy, qz, qw, metres; NaN "
           "where one "
           "is not known\n"
           "time: seconds, later than that of the last cycle\n"
           "Returns SceneAnswers with a row for each named pair and each pair that is near.")
      .def("restart", &PythonSceneTracker::restart, "Every pair starts cold in its next cycle.")
      .def_property_readonly("scene", &PythonSceneTracker::scene);
}

}  // namespace concave_distance::python
