#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// A file that belongs to a saved scene.
struct SavedFile {
  std::string name;  ///< without a folder
  std::string text;
};

/// A scene file that save_scene writes begins with this line.
inline constexpr const char* kSavedSceneMark = "# Scene of concave_distance, written by save_scene.";

/// Writes a scene as a scene file: its own as it was loaded, and the operations since. Meshes that came in
/// messages become OBJ files, named by their content. Resources with a scheme (package://) stay as they were
/// given, other paths of operations become absolute.
/// @param stem of the names of the files: `<stem>.yaml`, `<stem>_<hash>.obj`
/// @param with_meshes false: the scene file alone
/// @return the scene file, then the meshes that it names
/// @throws Error for a scene that was not loaded, and for a body that was added without its shape
std::vector<SavedFile> savedScene(const Scene& scene, const std::string& stem, bool with_meshes = true);

}  // namespace concave_distance::detail
