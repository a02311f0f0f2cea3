#pragma once

#include <map>
#include <string>

#include "concave_distance/scene/resource_locator.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

enum class GeometrySource : std::uint8_t { Collision, Visual };

struct SceneLoadOptions {
  PackageLocator package_locator;
  GeometrySource geometry = GeometrySource::Collision;  ///< default; a scene file's robot may override
  /// URDF texts by parameter name, e.g. {"robot_description", ...}; a scene file refers to them by name.
  std::map<std::string, std::string> descriptions;
  PairSettings default_settings;
};

/// Loads a scene YAML (doc/scene_file.md): robots from descriptions or files, bodies, groups, pairs. A body
/// that cannot be loaded becomes a problem of the scene, the rest goes on.
/// @throws Error for a file that cannot be read or parsed, an unknown key, a value out of range: file, line,
///         key, the value seen and what is allowed
Scene loadSceneFile(const std::string& path, const SceneLoadOptions& options);
/// The same from text; `where` names it in errors, relative paths are looked up from `base_folder`.
Scene loadSceneText(const std::string& yaml, const std::string& where, const std::string& base_folder,
                    const SceneLoadOptions& options);

/// A scene of one robot and nothing else, all pairs but adjacent links enabled.
Scene loadRobotScene(const std::string& urdf, const std::string& where, const SceneLoadOptions& options);

/// One body from a mesh file or primitive given by the fields below, as the scene file's `bodies` entries.
struct BodyDescription {
  std::string name;
  std::string frame;
  std::string mesh_resource;  ///< either this ...
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  std::string primitive;           ///< ... or box, sphere, cylinder, capsule with `dimensions`
  std::vector<double> dimensions;  ///< box x y z; sphere radius; cylinder and capsule radius, length; metres
  Eigen::Isometry3d frame_from_geometry = Eigen::Isometry3d::Identity();
  std::optional<double> max_edge_length;
  std::optional<double> chord_error;  ///< metres; empty: 1 % of the radius
};
/// @throws Error naming the body
SceneBody loadBody(const BodyDescription& description, const std::string& base_folder,
                   const PackageLocator& package_locator);

}  // namespace concave_distance
