#include "scene_loader.h"

#include <ros/console.h>
#include <ros/package.h>

#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "scene/body_pool.h"

namespace concave_distance {
namespace {

// loadRobotScene looks for the SRDF here; a robot may have none.
constexpr const char* kSemanticDescription = "robot_description_semantic";
constexpr const char* kSemanticSuffix = "_semantic";  // of the parameter's name, as in MoveIt

// Bodies can be added to this scene.
Scene emptyScene(const SceneLoadOptions& options) {
  Scene scene;
  scene.pool = options.pool ? options.pool : std::make_shared<BodyPool>(options.metric_memory_limit);
  scene.limits = options.limits;
  scene.defaults.pairs = options.default_settings;
  scene.file = std::make_shared<const SceneText>(SceneText{"bodies: []\n", "", {}});
  return scene;
}

Scene loadRobot(const std::string& urdf, const std::string& name, const SceneLoadOptions& options) {
  try {
    return loadRobotScene(urdf, name, options);
  } catch (const Error& problem) {
    Scene scene = emptyScene(options);
    scene.problems.push_back({problem.where(), problem.whatIsWrong() + " (" + problem.remedy() + ")"});
    return scene;
  }
}

// rospack writes to the terminal for each package that it does not find: it is asked once for each.
PackageLocator rememberedPackagePath() {
  struct Known {
    std::mutex mutex;
    std::map<std::string, std::string> folders;
  };
  return [known = std::make_shared<Known>()](const std::string& package) {
    const std::lock_guard<std::mutex> lock(known->mutex);
    const auto [place, is_new] = known->folders.try_emplace(package);
    if (is_new) place->second = rosPackagePath(package);
    return place->second;
  };
}

}  // namespace

std::optional<FoundDescription> findDescription(const ros::NodeHandle& node, const std::string& name,
                                                bool cached) {
  return searchDescription(node.getNamespace(), name, [&](const std::string& key) {
    std::string text;
    const bool is_there = cached ? node.getParamCached(key, text) : node.getParam(key, text);
    return is_there ? std::optional<std::string>(text) : std::nullopt;
  });
}

void logScene(const Scene& scene, double seconds) {
  for (const std::string& note : scene.notes) {
    ROS_INFO_STREAM(note);
  }
  for (const std::string& warning : scene.warnings) {
    ROS_WARN_STREAM(warning);
  }
  for (const SceneProblem& problem : scene.problems) {
    ROS_ERROR_STREAM("Not loaded: " << problem.where << ": " << problem.message);
  }
  ROS_INFO("The scene has %zu bodies and %zu pairs; %zu parts could not be loaded. It took %.1f s.",
           scene.bodies.size(), scene.pairs.size() + countPairsByRule(scene), scene.problems.size(), seconds);
}

std::string rosPackagePath(const std::string& package) {
  return ros::package::getPath(package);
}

SceneRequest requestScene(const NodeParameters& parameters, const ros::NodeHandle& node) {
  SceneRequest request;
  std::vector<std::string> names;
  if (!parameters.scene_file.empty()) {
    names = descriptionsOfSceneFile(parameters.scene_file);
  } else if (!parameters.robot_description.empty()) {
    names.push_back(parameters.robot_description);
  }
  for (const std::string& name : names) {
    const std::optional<FoundDescription> found = findDescription(node, name);
    if (!found) {
      request.waiting_for = "there is no parameter '" + name + "' with the robot's description";
      return request;
    }
    request.descriptions[name] = request.parameters[name] = found->text;
  }
  if (parameters.scene_file.empty() && !parameters.robot_description.empty()) {
    const std::string name = parameters.robot_description + kSemanticSuffix;
    const auto srdf = findDescription(node, name);
    if (srdf && srdf->is_xml)
      request.descriptions[kSemanticDescription] = request.parameters[name] = srdf->text;
  }
  return request;
}

Scene loadScene(const NodeParameters& parameters, const SceneRequest& request, LoadProgress& progress,
                const std::shared_ptr<BodyPool>& pool) {
  SceneLoadOptions options;
  options.package_locator = rememberedPackagePath();
  options.mesh_search_path = parameters.mesh_search_folders;
  options.geometry = parameters.geometry;
  options.default_settings = parameters.pair;
  options.limits = {parameters.limits.largest_body_count, parameters.limits.largest_pair_count,
                    parameters.limits.largest_triangle_count, parameters.limits.largest_node_count};
  options.mesh_import = parameters.mesh_access.limits;
  options.mesh_import.stop = progress.stopped_with != nullptr ? progress.stopped_with : &progress.stop;
  options.descriptions = request.descriptions;
  options.progress = &progress;
  options.pool = pool;
  options.clouds = true;
  options.automatic_cutoff = parameters.automatic_cutoff;
  options.skip_overlapping_pairs = parameters.skip_overlapping_pairs;
  if (parameters.chord_error > 0.0) options.chord_error = parameters.chord_error;
  if (!parameters.scene_file.empty()) {
    return loadSceneFile(parameters.scene_file, options);
  }
  if (parameters.robot_description.empty()) {
    return emptyScene(options);
  }
  return loadRobot(request.descriptions.at(parameters.robot_description), parameters.robot_description,
                   options);
}

SceneLoader::~SceneLoader() {
  if (thread_.joinable()) {
    progress_->stop = true;
    thread_.join();
  }
}

void SceneLoader::start(const NodeParameters& parameters, SceneRequest request) {
  progress_ = std::make_shared<LoadProgress>();
  outcome_ = Outcome();
  done_ = false;
  start_ = ros::WallTime::now();
  request_ = std::move(request);
  thread_ = std::thread([this, parameters] {
    try {
      outcome_.scene = loadScene(parameters, request_, *progress_);
    } catch (const Error& error) {
      outcome_.error = error;
    } catch (const std::exception& exception) {  // memory, for one
      outcome_.error =
          Error("scene", exception.what(), "free memory, or report this as an error of the package");
    }
    done_ = true;
  });
}

double SceneLoader::seconds() const {
  return (ros::WallTime::now() - start_).toSec();
}

std::string SceneLoader::progress() const {
  return "prepared " + std::to_string(progress_->prepared()) + " of " + std::to_string(progress_->bodies()) +
         " bodies, " + fixedText(seconds(), 1) + " s";
}

std::optional<SceneLoader::Outcome> SceneLoader::take() {
  if (!thread_.joinable() || !done_) {
    return std::nullopt;
  }
  thread_.join();
  return std::exchange(outcome_, Outcome());
}

}  // namespace concave_distance
