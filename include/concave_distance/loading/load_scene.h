#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/loading/mesh_roots.h"
#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/scene_limits.h"

namespace concave_distance {

inline constexpr std::size_t kDefaultMetricMemoryLimit = 512'000'000;

/// Progress of loading a scene, read and stopped from another thread.
class LoadProgress {
 public:
  void begin(std::size_t bodies) { bodies_ += bodies; }
  void finishBody() { ++prepared_; }
  /// Number of bodies to prepare; 0 before it is known.
  std::size_t bodies() const { return bodies_; }
  std::size_t prepared() const { return prepared_; }

  /// When set, bodies not begun are left out and the result is not usable.
  std::atomic<bool> stop{false};
  const std::atomic<bool>* stopped_with = nullptr;  ///< the same, of somebody else; nullptr: nobody
  bool isStopped() const { return stop || (stopped_with != nullptr && *stopped_with); }

 private:
  std::atomic<std::size_t> bodies_{0};
  std::atomic<std::size_t> prepared_{0};
};

enum class GeometrySource : std::uint8_t { Collision, Visual };

struct SceneLoadOptions {
  PackageLocator package_locator = packagePathFromEnvironment;
  /// If true, what cannot be loaded is an error; else it is a problem of the scene, whose rest is served.
  bool strict = false;
  /// Folders to search for meshes that are not found at their package:// or relative path; a file, such as
  /// the URDF, means its folder and the three above that.
  std::vector<std::string> mesh_search_path;
  LoadProgress* progress = nullptr;  ///< nullptr: none
  /// If true, loadRobotScene scales the cutoff to the robot and ignores that in `default_settings`.
  bool automatic_cutoff = false;
  /// If true, loadRobotScene leaves out pairs whose bodies overlap in every pose tried.
  bool skip_overlapping_pairs = false;
  /// loadRobotScene takes this chord error for the meshes of round primitives, metres; empty: 1 %
  /// of the radius.
  std::optional<double> chord_error;
  GeometrySource geometry = GeometrySource::Collision;  ///< default; a scene file's robot may override
  /// If true, the caller receives the clouds that a scene file names (SceneBody::cloud); else they are left
  /// out with a warning.
  bool clouds = false;
  /// URDF texts by parameter name, e.g. {"robot_description", ...}; a scene file refers to them by name.
  std::map<std::string, std::string> descriptions;
  PairSettings default_settings;
  /// Bytes that the matrices of all mesh metrics may take together, including those of bodies added later. A
  /// body gets its matrices at its first search if the rest of the limit holds them; those of the others hold
  /// 128 nodes.
  std::size_t metric_memory_limit = kDefaultMetricMemoryLimit;
  /// Meshes are shared with the scene of this pool where they are equal; nullptr: with none.
  std::shared_ptr<BodyPool> pool;
  SceneLimits limits;
  MeshImportLimits mesh_import;  ///< of each mesh file
};

/// Loads a scene YAML (doc/scene_file.md): robots from descriptions or files, bodies, groups, pairs. A body
/// that cannot be loaded becomes a problem of the scene, the rest goes on.
/// @throws Error for a file that cannot be read or parsed, an unknown key, a value out of range: file, line,
///         key, the value seen and what is allowed; with `strict` for the first problem
[[nodiscard]] Scene loadSceneFile(const std::string& path, const SceneLoadOptions& options);
/// The same from text; `where` names it in errors, relative paths are looked up from `base_folder`.
[[nodiscard]] Scene loadSceneText(const std::string& yaml, const std::string& where,
                                  const std::string& base_folder, const SceneLoadOptions& options);

/// Names of the parameters that a scene file wants in SceneLoadOptions::descriptions, so that the caller can
/// fetch them first. @throws Error as loadSceneFile
std::vector<std::string> descriptionsOfSceneFile(const std::string& path);

/// A scene of one robot and nothing else, all pairs but adjacent links enabled; those neither that an SRDF
/// among the descriptions, `robot_description_semantic`, disables. Pairs that overlap in the robot's zero
/// pose and in every one of 20 random poses are named in the scene's warnings.
/// @param where names the URDF in messages; relative mesh paths start at its folder when it is a file
/// @throws Error when urdfdom cannot parse the text; with `strict` for the first problem
[[nodiscard]] Scene loadRobotScene(const std::string& urdf, const std::string& where,
                                   const SceneLoadOptions& options);

/// One body, as the scene file's `bodies` entries: of the shape that the inherited fields give, and more.
struct BodyDescription : BodyShape {
  std::string name;
  std::string frame;
  std::vector<BodyShape> other_shapes;  ///< of the same body
  std::optional<double> max_edge_length;
  std::optional<double> chord_error;  ///< metres; empty: 1 % of each radius
  MeshAccess mesh_access;             ///< which mesh files may be read, and the limits for it
};
/// A body, or why there is none.
struct LoadedBody {
  std::optional<SceneBody> body;
  std::optional<Error> problem;
};
/// Loads bodies as a scene does, in parallel; one result for each, in their order. The parameters are those
/// of loadBody().
[[nodiscard]] std::vector<LoadedBody> loadBodies(const std::vector<BodyDescription>& descriptions,
                                                 const std::string& base_folder,
                                                 const PackageLocator& package_locator,
                                                 const std::shared_ptr<BodyPool>& pool,
                                                 const SceneLimits& limits);
/// Loads one body as a scene does.
/// @param pool of its scene; nullptr: a new one
/// @param limits only those of one body apply
/// @throws Error naming the body
[[nodiscard]] SceneBody loadBody(const BodyDescription& description, const std::string& base_folder,
                                 const PackageLocator& package_locator,
                                 const std::shared_ptr<BodyPool>& pool = nullptr,
                                 const SceneLimits& limits = {});

}  // namespace concave_distance
