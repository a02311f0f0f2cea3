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

struct SavedScene {
  std::vector<SavedFile> files;      ///< the scene file, then the meshes that it names
  std::vector<std::string> remarks;  ///< what a scene file cannot say
};

/// Writes a scene as a scene file, from which it is loaded with the same answers to the last bit: bodies
/// where they are, rules, listed pairs, attachments. Meshes that came in messages become OBJ files, named by
/// their content. Resources with a scheme (package://) stay as they were given, other paths become absolute.
/// @param stem of the names of the files: `<stem>.yaml`, `<stem>_<hash>.obj`
/// @param with_meshes false: the scene file alone
/// @throws Error for a body whose origin is not known
SavedScene savedScene(const Scene& scene, const std::string& stem, bool with_meshes = true);

/// Returns a resource as another folder can name it too: with a scheme as it is, else an absolute path.
std::string savedResource(const std::string& resource, const std::string& base_folder);

}  // namespace concave_distance::detail
