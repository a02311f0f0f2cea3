#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "build_bodies.h"
#include "link_adjacency.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// Frames that no joint moves against each other, as sets. A frame that was never joined is alone.
class RigidFrames {
 public:
  void join(const std::string& a, const std::string& b);
  bool areJoined(const std::string& a, const std::string& b) const;

 private:
  std::string rootOf(std::string frame) const;
  std::map<std::string, std::string> parent_;
};

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

  /// Why a pair is not watched unless the scene file names both bodies; nullptr when it is.
  const char* filterReason(std::size_t source_a, std::size_t source_b) const;
};

/// Adds the links of a robot. @param srdf nullptr when there is none
/// @throws Error for a URDF or SRDF that cannot be read, a name that is taken, a pattern that matches no link
void addRobot(const RobotSpec& spec, const DescriptionText& urdf, const DescriptionText* srdf,
              SceneParts& parts);

/// Adds a body of the scene file. @throws Error for a name that is taken
void addBody(const BodySpec& spec, const std::string& base_folder, SceneParts& parts);

/// The source of a single body.
BodySource sourceOf(const BodyDescription& description, const std::string& base_folder);

}  // namespace concave_distance::detail
