#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "build_bodies.h"
#include "concave_distance/kinematics/robot_kinematics.h"
#include "concave_distance/scene/rigid_frames.h"
#include "concave_distance/scene/scene.h"
#include "link_adjacency.h"
#include "robot_description.h"
#include "scene_spec.h"
#include "semantic_description.h"

namespace concave_distance::detail {

/// A URDF or SRDF text, with where it came from and where its relative paths start.
struct DescriptionText {
  std::string text;
  std::string where;
  std::string base_folder;  ///< empty: no relative paths
};

/// All that can be in a scene, before anything is loaded.
struct SceneParts {
  std::vector<BodySource> sources;   ///< robots in order, their links in the order of the URDF, then bodies
  std::set<std::string> bare_links;  ///< links without geometry: known names, no bodies
  RigidFrames rigid;
  std::set<LinkPair> adjacent;                                           ///< by body name
  std::set<LinkPair> disabled_by_srdf;                                   ///< by body name
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  ///< of robots and SRDFs: body names
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  std::vector<std::shared_ptr<const RobotKinematics>> robots;  ///< those whose joints can be moved
  std::vector<SceneProblem> problems;                          ///< URDFs and SRDFs that cannot be read
  bool robot_failed = false;  ///< a name that nobody knows may be one of its links

  static constexpr const char* kDisabledBySrdf = "disabled in the SRDF";
  static constexpr const char* kRigid = "no joint moves one against the other";
  static constexpr const char* kAdjacent = "adjacent links";
  /// Returns why a pair is not watched unless the scene file names both bodies; nullptr when it is.
  const char* filterReason(std::size_t source_a, std::size_t source_b) const;
};

/// Adds the links of a robot that was read from `urdf`.
/// @throws Error for a name that is taken, a pattern that matches no link
void addRobot(const RobotSpec& spec, const RobotDescription& robot, const DescriptionText& urdf,
              SceneParts& parts);

/// Adds the disabled pairs and the groups of that robot's SRDF.
void addSemantics(const RobotSpec& spec, const SemanticDescription& semantics, SceneParts& parts);

/// Adds a body of the scene file. @throws Error for a name that is taken
void addBody(const BodySpec& spec, const std::string& base_folder, SceneParts& parts);

BodySource sourceOf(const BodyDescription& description, const std::string& base_folder);

/// Sets the limits for every mesh file of every body.
void limitImports(SceneParts& parts, const MeshImportLimits& limits);

}  // namespace concave_distance::detail
