#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scene_parts.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// Turns what a scene file calls bodies by - names, groups, patterns - into bodies.
class BodySelector {
 public:
  struct Selection {
    std::vector<std::size_t> sources;  ///< numbers in SceneParts::sources, each once
    bool names_one = false;            ///< a body by its own name ...
    bool is_bare_link = false;         ///< ... or a link without geometry, and no source
    bool is_lost = false;              ///< not known; perhaps of a robot whose URDF could not be read
  };

  /// Resolves the file's groups; those of robots and SRDFs give way to names of the file, with a note.
  /// @throws Error for a group's member that is not known
  BodySelector(const SceneParts& parts, const std::vector<GroupSpec>& groups,
               std::vector<std::string>& notes);

  /// @throws Error when the text is no body, group or link, and no pattern that matches one, and every robot
  ///         could be read
  Selection select(const Selector& selector) const;

  /// Numbers in SceneParts::sources, by group.
  const std::map<std::string, std::vector<std::size_t>>& groups() const { return groups_; }

 private:
  const SceneParts& parts_;
  std::map<std::string, std::size_t> source_of_name_;
  std::map<std::string, std::vector<std::size_t>> groups_;
};

}  // namespace concave_distance::detail
