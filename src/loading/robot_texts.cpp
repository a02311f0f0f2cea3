#include "robot_texts.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "robot_description.h"
#include "semantic_description.h"

namespace concave_distance::detail {
namespace {

constexpr std::uintmax_t kLongestFile = 64'000'000;  // bytes, of a scene file, URDF or SRDF

DescriptionText textOfParameter(const std::string& parameter, const std::string& where,
                                const SceneLoadOptions& options) {
  const auto found = options.descriptions.find(parameter);
  if (found == options.descriptions.end()) {
    throw Error(where, "there is no parameter '" + parameter + "'",
                "set it to the text of the description, or name a file by urdf or srdf");
  }
  return {found->second, "parameter " + parameter, ""};
}

DescriptionText textOfFile(const std::string& resource, const std::string& where,
                           const std::string& base_folder, const SceneLoadOptions& options) {
  try {
    const std::string path = locateResource(resource, base_folder, options.package_locator);
    return {readTextFile(path, path), path, folderOf(path)};
  } catch (const Error& error) {
    throw Error(where + ", " + error.where(), error.whatIsWrong(), error.remedy());
  }
}

SceneProblem problemOf(const Error& error, const std::string& consequence) {
  return {error.where(), error.whatIsWrong() + " (" + error.remedy() + "); " + consequence};
}

}  // namespace

std::string readTextFile(const std::string& path, const std::string& where) {
  std::error_code ignored;
  std::ifstream stream;
  // A folder can be opened, and fails only when it is read.
  if (std::filesystem::is_regular_file(path, ignored)) stream.open(path, std::ios::binary);
  if (const auto size = std::filesystem::file_size(path, ignored); stream.is_open() && size > kLongestFile) {
    throw Error(where, "'" + path + "' has " + std::to_string(size) + " bytes",
                "allowed: at most " + std::to_string(kLongestFile));
  }
  TextStream text;
  if (stream.is_open()) text << stream.rdbuf();
  if (!stream.is_open() || stream.bad()) {
    throw Error(where, "'" + path + "' cannot be read", "check the path and its permissions");
  }
  return text.str();
}

std::string folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

void readSemantics(const RobotSpec& spec, const RobotDescription& robot, const std::string& base_folder,
                   const SceneLoadOptions& options, SceneParts& parts) {
  if (spec.srdf.empty() && spec.semantic_description.empty()) return;
  DescriptionText srdf;
  if (spec.srdf.empty()) srdf = textOfParameter(spec.semantic_description, spec.where, options);
  try {
    if (!spec.srdf.empty()) srdf = textOfFile(spec.srdf, spec.where, base_folder, options);
    addSemantics(spec, readSemanticDescription(srdf.text, srdf.where, robot), parts);
  } catch (const Error& error) {
    parts.problems.push_back(problemOf(error, "no pair is disabled by it, and it gives no groups"));
  }
}

void readRobot(const RobotSpec& spec, const std::string& base_folder, const SceneLoadOptions& options,
               SceneParts& parts) {
  DescriptionText urdf;
  RobotDescription robot;
  if (spec.urdf.empty()) urdf = textOfParameter(spec.description, spec.where, options);
  try {
    if (!spec.urdf.empty()) urdf = textOfFile(spec.urdf, spec.where, base_folder, options);
    robot = readRobotDescription(urdf.text, urdf.where, spec.geometry);
  } catch (const Error& error) {
    parts.problems.push_back(problemOf(error, "no link of this robot is served"));
    parts.robot_failed = true;
    return;
  }
  addRobot(spec, robot, urdf, parts);
  readSemantics(spec, robot, base_folder, options, parts);
}

}  // namespace concave_distance::detail
