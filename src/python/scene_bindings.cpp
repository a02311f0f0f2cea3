#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/csv_table.h"
#include "bindings.h"
#include "concave_distance/base/error.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/loading/load_scene.h"
#include "joint_positions.h"
#include "parameter_arguments.h"
#include "pose_arrays.h"
#include "python_scene.h"
#include "text.h"
#include "unlocked.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

using Texts = std::vector<std::string>;

std::string readText(const std::string& path) {
  requireReadableFile(path);
  std::string text;
  try {
    std::ifstream file(path, std::ios::binary);
    file.exceptions(std::ios::badbit | std::ios::failbit);
    text.assign(std::istreambuf_iterator<char>(file), {});
  } catch (const std::exception&) {
    throw Error(path, "the file cannot be read", "check its path and permissions");
  }
  return text;
}

SceneLoadOptions loadOptions(const Texts& package_folders, const Texts& mesh_folders, bool strict,
                             const std::string& where, const py::kwargs& keywords) {
  SceneLoadOptions options;
  if (!package_folders.empty()) options.package_locator = packagesBelow(package_folders);
  options.mesh_search_path = mesh_folders;
  options.strict = strict;
  setParameters(keywords, where, options.default_settings);
  return options;
}

GeometrySource geometryOf(const std::string& name) {
  if (name == "collision") return GeometrySource::Collision;
  if (name == "visual") return GeometrySource::Visual;
  throw Error("geometry", "the value is '" + name + "'", "allowed: collision, visual");
}

ScenePointer loadSceneOf(const std::string& path, const Texts& package_folders, const Texts& mesh_folders,
                         bool strict, const std::map<std::string, std::string>& descriptions,
                         const std::string& geometry, const py::kwargs& keywords) {
  SceneLoadOptions options = loadOptions(package_folders, mesh_folders, strict, "load_scene", keywords);
  options.descriptions = descriptions;
  options.geometry = geometryOf(geometry);
  const Unlocked unlocked;
  return std::make_shared<PythonScene>(loadSceneFile(path, options));
}

ScenePointer loadRobotOf(const std::string& urdf, const std::optional<std::string>& srdf,
                         const Texts& package_folders, const Texts& mesh_folders, bool strict,
                         const std::string& geometry, bool skip_overlapping_pairs, bool automatic_cutoff,
                         const py::kwargs& keywords) {
  SceneLoadOptions options = loadOptions(package_folders, mesh_folders, strict, "load_robot", keywords);
  options.geometry = geometryOf(geometry);
  options.skip_overlapping_pairs = skip_overlapping_pairs;
  options.automatic_cutoff = automatic_cutoff;
  options.mesh_search_path.push_back(urdf);
  const Unlocked unlocked;
  if (srdf) options.descriptions["robot_description_semantic"] = readText(*srdf);
  return std::make_shared<PythonScene>(loadRobotScene(readText(urdf), urdf, options));
}

Texts robotNames(const PythonScene& scene) {
  Texts names;
  for (const auto& robot : scene.joints->robots()) names.push_back(robot->name());
  return names;
}

Texts bodyFrames(const PythonScene& scene) {
  Texts frames;
  for (const SceneBody& body : scene.scene.bodies) frames.push_back(body.frame);
  return frames;
}

py::array_t<double> posesInFrames(const PythonScene& scene) {
  py::array_t<double> poses(
      {static_cast<py::ssize_t>(scene.scene.bodies.size()), py::ssize_t{4}, py::ssize_t{4}});
  double* at = poses.mutable_data();
  for (const SceneBody& body : scene.scene.bodies) {
    writeMatrix(body.frame_from_body, at);
    at += 16;
  }
  return poses;
}

Texts bodyNames(const PythonScene& scene) {
  Texts names;
  for (const SceneBody& body : scene.scene.bodies) names.push_back(body.name);
  return names;
}

py::list messagesOf(const Texts& messages) {
  py::list texts;
  for (const std::string& message : messages) texts.append(toPython(inKeywords(message)));
  return texts;
}

py::list problemsOf(const PythonScene& scene) {
  py::list problems;
  for (const SceneProblem& problem : scene.scene.problems)
    problems.append(py::make_tuple(toPython(problem.where), toPython(inKeywords(problem.message))));
  return problems;
}

py::array_t<double> posesOf(const PythonScene& scene, const py::object& positions, const py::object& roots) {
  const JointPositions given(scene, positions, roots);
  const std::size_t bodies = scene.joints->bodyCount();
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(bodies), 4, 4};
  if (given.isArray()) shape.insert(shape.begin(), static_cast<py::ssize_t>(given.count()));
  py::array_t<double> poses(shape);
  double* at = poses.mutable_data();
  const Unlocked unlocked;
  SceneState state = scene.joints->startState();
  given.placeRoots(state);
  for (std::size_t i = 0; i < given.count(); ++i) {
    scene.joints->evaluate(given.row(i), state);
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

constexpr const char* kLoadingDoc =
    "package_folders: where package:// is looked for first; after that as ROS does\n"
    "mesh_folders: searched for meshes that are not where the file says\n"
    "strict: the first thing that cannot be loaded raises Error; else it is in Scene.problems\n"
    "Further keywords: defaults of the pairs, as parameters() without margins and niches_wanted.\n"
    "Raises Error naming file, line and key.";

void bindLoading(py::module& module) {
  module.def("load_scene", &loadSceneOf, py::arg("path"), py::arg("package_folders") = Texts(),
             py::arg("mesh_folders") = Texts(), py::arg("strict") = false,
             py::arg("descriptions") = std::map<std::string, std::string>(),
             py::arg("geometry") = "collision",
             (std::string("Loads a scene file.\n\ndescriptions: URDF texts by the names that the file has\n"
                          "geometry: of robots for which the file says nothing, 'collision' or 'visual'\n") +
              kLoadingDoc)
                 .c_str());
  module.def("descriptions_of_scene", &descriptionsOfSceneFile, py::arg("path"),
             "Names of the robots' descriptions that a scene file takes from parameters. Raises Error.");
  module.def("load_robot", &loadRobotOf, py::arg("urdf"), py::arg("srdf") = py::none(),
             py::arg("package_folders") = Texts(), py::arg("mesh_folders") = Texts(),
             py::arg("strict") = false, py::arg("geometry") = "collision",
             py::arg("skip_overlapping_pairs") = false, py::arg("automatic_cutoff") = false,
             (std::string("Loads a robot: every link a body, every two links a pair but adjacent ones.\n\n"
                          "urdf: path of the file; srdf: of one that disables pairs\n"
                          "geometry: which of the URDF's, 'collision' or 'visual'\n"
                          "skip_overlapping_pairs: leaves out links that overlap in every pose tried, else "
                          "Scene.warnings names them\n"
                          "automatic_cutoff: a fifth of the robot's diagonal, as the node has it\n") +
              kLoadingDoc)
                 .c_str());
}

}  // namespace

void bindScenes(py::module& module) {
  bindLoading(module);
  py::class_<PythonScene, ScenePointer>(module, "Scene", "Bodies, pairs and robots; immutable.")
      .def_property_readonly("body_names", &bodyNames)
      .def_property_readonly("body_frames", &bodyFrames, "The tf frame that each body is fixed to.")
      .def_property_readonly("poses_in_frames", &posesInFrames,
                             "(b, 4, 4): where the bodies are in their frames.")
      .def_property_readonly("problems", &problemsOf,
                             "A list of (where, message): what could not be loaded; the rest is served.")
      .def_property_readonly("warnings",
                             [](const PythonScene& scene) { return messagesOf(scene.scene.warnings); })
      .def_property_readonly("notes", [](const PythonScene& scene) { return messagesOf(scene.scene.notes); })
      .def_property_readonly("robot_names", &robotNames, "Names of the robots, r of them.")
      .def_property_readonly(
          "position_names", [](const PythonScene& scene) { return scene.joints->positionNames(); },
          "Names of the joint positions of all robots, p of them.")
      .def_property_readonly(
          "velocity_names", [](const PythonScene& scene) { return scene.joints->velocityNames(); },
          "Names of the joint velocities of all robots, v of them: as position_names, but for floating "
          "joints.")
      .def_property_readonly(
          "rest_positions", [](const PythonScene& scene) { return scene.joints->restPositions(); },
          "(p,) rad or m: zero, or the middle of a range without zero.")
      .def("poses_of_bodies", &posesOf, py::arg("positions"), py::arg("roots") = py::none(),
           "Where the bodies are for joint positions.\n\n"
           "positions: (p,) or (n, p), rad or m, in the order of position_names\n"
           "roots: where the roots of robots are in the world, (r, 4, 4) or (r, 7), in the order of "
           "robot_names; "
           "None: at its origin\n"
           "Returns (b, 4, 4) or (n, b, 4, 4), NaN for a body whose pose in the world is not known. Raises "
           "Error.");
}

}  // namespace concave_distance::python
