#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Says what a reload does with each body, by name, and which operations no longer fit, each with the reason.
struct ReloadReport {
  std::vector<std::string> kept;        ///< bodies of files that go on with their niches and ids
  std::vector<std::string> replaced;    ///< ... that have another shape now
  std::vector<std::string> added;       ///< ... that are new
  std::vector<std::string> removed;     ///< ... that are gone
  std::vector<std::string> kept_edits;  ///< bodies that services added, and files' bodies that they removed
  std::vector<std::string> dropped;
};

/// Returns the scene that a reload serves: what the files say now and, unless `drop_edits`, the operations
/// since the last load. A body with the same name and mesh is the same body (SceneBody::serial).
/// @param fresh as it was loaded now, its meshes shared with `current` where they are equal
Scene reloadedScene(const Scene& current, Scene fresh, bool drop_edits, ReloadReport& report);

}  // namespace concave_distance::detail
