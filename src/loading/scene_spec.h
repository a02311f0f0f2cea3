#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// These structs hold what a scene file says, checked as far as that goes without loading anything. `where`
/// is the place in the file.

/// A body's name, a group's name or a pattern, as the file has it.
struct Selector {
  std::string where;
  std::string text;
};

/// Holds what a file says of one link of a robot.
struct LinkSpec {
  std::string where;
  std::optional<double> margin;  ///< metres; empty: the robot's
  std::string label;             ///< empty: from its name
};

struct RobotSpec {
  std::string where;
  std::string name;                  ///< of its group; empty: `<prefix><name in the URDF>`
  std::string description;           ///< parameter with the URDF, or empty and
  std::string urdf;                  ///< ... the file
  std::string semantic_description;  ///< parameter with the SRDF, or
  std::string srdf;                  ///< ... the file, or neither
  std::string prefix;                ///< put before link names, in bodies and frames
  GeometrySource geometry = GeometrySource::Collision;
  std::vector<Selector> skipped_links;
  double margin = 0.0;  ///< metres, of each link
  std::optional<double> max_edge_length;
  std::optional<double> chord_error;
  Material material;
  std::map<std::string, LinkSpec> own;  ///< by the link's name in the URDF
};

struct BodySpec {
  std::string where;
  BodyDescription description;
  Eigen::Vector4d colour = SceneBody().colour;
  double margin = 0.0;  ///< metres
  Material material;
  std::string label;                                                  ///< empty: from its name
  Eigen::Isometry3d frame_from_body = Eigen::Isometry3d::Identity();  ///< besides the poses of its shapes
  std::shared_ptr<const CloudState> cloud;                            ///< of an entry of `clouds`
};

struct GroupSpec {
  std::string where;
  std::string name;
  std::vector<Selector> members;
};

/// One side of an entry: what it names, or all that a list names.
struct SideSpec {
  std::vector<Selector> names;
  bool is_list = false;
};

struct PairSpec {
  std::array<SideSpec, 2> between;
  bool is_ordered = false;         ///< only pairs whose earlier body is on the first side
  bool is_watched = true;          ///< false: it says how those pairs are watched that added bodies ask for
  bool later_is_a = false;         ///< of an ordered one
  std::string name;                ///< empty: from the bodies
  std::optional<YamlValue> entry;  ///< for readPairEntry; nothing: all settings are the defaults
};

struct SceneSpec {
  std::vector<RobotSpec> robots;
  std::vector<BodySpec> bodies;
  std::vector<GroupSpec> groups;
  std::optional<std::vector<PairSpec>> pairs;  ///< nothing: every body against every other
  std::vector<std::array<Selector, 2>> disabled;
  SceneDefaults defaults;
  std::size_t metric_memory_limit = 0;  ///< bytes
  std::optional<SimulationSettings> simulation;
};

/// @param base_folder where relative paths start; empty: the working directory
/// @throws Error: file, line, key, what is wrong and what is allowed
SceneSpec readSceneSpec(const std::string& yaml, const std::string& file, const std::string& base_folder,
                        const SceneLoadOptions& options);

/// Lays the settings of a pair's entry over `settings`, and says whether the pair is enabled when
/// the entry does.
void readPairEntry(const YamlValue& entry, PairSettings& settings, std::optional<bool>& enabled);

}  // namespace concave_distance::detail
