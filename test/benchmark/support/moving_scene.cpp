#include "benchmark/support/moving_scene.h"

#include <urdf_parser/urdf_parser.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "benchmark/support/joint_path.h"
#include "benchmark/support/swaying_joints.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"

namespace concave_distance::benchmark {
namespace {

using Positions = std::map<std::string, double>;

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

SceneLoadOptions loadOptions() {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  return options;
}

MovingScene demoScene(const std::string& name) {
  const std::string folder = CONCAVE_DISTANCE_SOURCE_DIR;
  const std::string urdf = textOf(folder + "/urdf/wam.urdf");
  SceneLoadOptions options = loadOptions();
  options.descriptions["robot_description"] = urdf;
  const NamedJointPath path = readJointPath(folder + "/config/wam_path.csv");
  return {name, loadSceneFile(folder + "/config/" + name + ".yaml", options), [path](double time) {
            const Eigen::VectorXd at = path.path.at(time);
            Positions positions;
            for (std::size_t i = 0; i < path.joints.size(); ++i) {
              positions[path.joints[i]] = at[static_cast<Eigen::Index>(i)];
            }
            return positions;
          }};
}

/// A robot beside itself, as the node loads it without a scene file.
MovingScene ownRobot(const std::string& files) {
  const std::size_t comma = files.find(',');
  const std::string path = files.substr(0, comma);
  const std::string urdf = textOf(path);
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(urdf);
  if (!model) throw Error(path, "the URDF cannot be read", "name robot, cell or a file with a URDF");
  SceneLoadOptions options = loadOptions();
  options.mesh_search_path = {path};
  options.automatic_cutoff = true;
  if (comma != std::string::npos) {
    options.descriptions["robot_description_semantic"] = textOf(files.substr(comma + 1));
  }
  return {std::filesystem::path(path).stem().string(), loadRobotScene(urdf, path, options),
          [joints = swayingJoints(*model)](double time) {
            Positions positions;
            for (const SwayingJoint& joint : joints) positions[joint.name] = joint.at(time);
            return positions;
          }};
}

}  // namespace

void MovingScene::move(double time, const SceneKinematics& kinematics, Eigen::VectorXd& positions) const {
  const Positions at = joints(time);
  const std::vector<std::string>& names = kinematics.positionNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto named = at.find(names[i]);
    if (named != at.end()) positions[static_cast<Eigen::Index>(i)] = named->second;
  }
}

MovingScene movingScene(const std::string& scene) {
  return scene == "robot" || scene == "cell" ? demoScene(scene) : ownRobot(scene);
}

}  // namespace concave_distance::benchmark
