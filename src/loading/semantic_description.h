#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "link_adjacency.h"
#include "robot_description.h"

namespace concave_distance::detail {

/// Holds what of an SRDF matters here. Links are named as in the URDF.
struct SemanticDescription {
  std::set<LinkPair> disabled;
  /// Groups with the links they hold, in the order of the text.
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
};

/// Reads disable_collisions, disable_default_collisions, enable_collisions and groups (links, joints by their
/// child link, chains without their base link, and other groups). Names without a link of the robot are left
/// out, with a note. An SRDF for a robot of another name is read with a warning when the robot has all the
/// links that it names.
/// @throws Error when the text is no SRDF, or that of another robot
SemanticDescription readSemanticDescription(const std::string& srdf, const std::string& where,
                                            const RobotDescription& robot);

}  // namespace concave_distance::detail
