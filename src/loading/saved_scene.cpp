#include "saved_scene.h"

#include <algorithm>
#include <utility>

#include "base/content_hash.h"
#include "concave_distance/base/error.h"
#include "mesh/import/obj_text.h"
#include "saved_operations.h"
#include "scene/journal.h"
#include "yaml_text.h"

namespace concave_distance::detail {
namespace {

// The text of the scene file, begun with the mark once.
std::string markedText(const std::string& text) {
  const std::string mark = std::string(kSavedSceneMark) + "\n";
  std::string marked = text.compare(0, mark.size(), mark) == 0 ? text : mark + text;
  if (marked.back() != '\n') marked += '\n';
  return marked;
}

}  // namespace

std::vector<SavedFile> savedScene(const Scene& scene, const std::string& stem, bool with_meshes) {
  if (!scene.file) throw Error("scene", "it was not loaded from a file", "load one, or an empty one");
  std::vector<SavedFile> meshes;
  const auto mesh_file = [&](const TriangleSoup& soup) {
    std::string text = objText(soup);
    std::string name = stem + "_" + hashBytes(text.data(), text.size()).text() + ".obj";
    const bool is_there =
        std::any_of(meshes.begin(), meshes.end(), [&](const SavedFile& file) { return file.name == name; });
    if (with_meshes && !is_there) meshes.push_back({name, std::move(text)});
    return name;
  };
  std::string text = markedText(scene.file->text) + "---\n# What services have changed since.\n";
  if (!scene.file->folder.empty()) text += "folder: " + yamlText(scene.file->folder) + "\n";
  text += "operations:";
  const SceneJournal journal = wholeJournal(scene);
  text += journal.empty() ? " []\n" : "\n";
  for (const auto& operation : journal) text += "  - " + savedOperation(*operation, mesh_file) + "\n";
  meshes.insert(meshes.begin(), {stem + ".yaml", std::move(text)});
  return meshes;
}

}  // namespace concave_distance::detail
