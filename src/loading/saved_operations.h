#pragma once

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene.h"
#include "scene/scene_operation.h"

namespace concave_distance::detail {

/// An operation as a file has it.
struct SavedOperation {
  std::string where;  ///< in the file
  SceneOperation operation;
  BodyDescription description;  ///< Add: of the body; what it leaves empty is as the scene's defaults
  SceneBody looks;              ///< Add: with its place, margin, colour and label
};

/// The two YAML documents of a scene file.
struct SceneDocuments {
  std::string scene;   ///< bodies, pairs, ...
  std::string folder;  ///< where relative paths in `scene` start
  std::vector<SavedOperation> operations;
};

/// Takes the text of a scene file apart and reads its operations. @param base_folder of the file
/// @throws Error: file, line, key, what is wrong and what is allowed
SceneDocuments readSceneDocuments(const std::string& yaml, const std::string& file,
                                  const std::string& base_folder);
/// Returns the first document of a scene file.
std::string sceneTextOf(const std::string& yaml);

/// Applies operations to a scene that was just loaded. What does not fit is a problem of the scene.
/// @param base_folder where their meshes' relative paths start
void applySaved(const std::vector<SavedOperation>& operations, const std::string& base_folder,
                const SceneLoadOptions& options, Scene& scene);

/// Returns an operation in one line, as readSceneDocuments() reads it.
/// @param mesh_file gives triangles the name of a file
std::string savedOperation(const SceneOperation& operation,
                           const std::function<std::string(const TriangleSoup&)>& mesh_file);

/// Returns a resource as another folder can name it too: with a scheme as it is, else an absolute path.
std::string savedResource(const std::string& resource, const std::string& base_folder);

}  // namespace concave_distance::detail
