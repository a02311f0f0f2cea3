#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "frames_now.h"

namespace concave_distance::detail {

/// Says what a reload does with each body, by name, and what it drops of the edits, each with the reason.
struct ReloadReport {
  std::vector<std::string> kept;        ///< bodies of files that go on with their niches and ids
  std::vector<std::string> replaced;    ///< ... that have another shape now
  std::vector<std::string> added;       ///< ... that are new
  std::vector<std::string> removed;     ///< ... that are gone
  std::vector<std::string> kept_edits;  ///< bodies that services added, and files' bodies that edits removed
  std::vector<std::string> dropped;
};

/// Returns the scene that a reload serves: what the files say now and, unless `drop_edits`, what edits have
/// made of the scene since it was loaded. Each body, margin, placement, rule and setting that an edit has
/// changed stays as edited, all else is as loaded. A body of a file with the same name and mesh is the same
/// body (SceneBody::serial).
/// @param current with Scene::loaded
/// @param fresh as it was loaded now, its meshes shared with `current` where they are equal
/// @throws Error when the scene would exceed its limit of bodies
Scene reloadedScene(const Scene& current, Scene fresh, bool drop_edits, const FramesNow& frames,
                    ReloadReport& report);

}  // namespace concave_distance::detail
