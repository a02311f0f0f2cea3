#pragma once

#include <string>
#include <vector>

#include "saved_scene.h"

namespace concave_distance::detail {

/// Returns the path of a scene that a request saves, below `folder` also where it is given as an absolute
/// one, without links.
/// @throws Error when it is empty, does not end in .yaml, or is not below the folder; when the folder is
/// empty
std::string pathBelow(const std::string& folder, const std::string& path);

/// Writes a saved scene: all its files, each complete, or none. The scene file comes last.
/// @param path of the scene file; the others are written beside it
/// @param overwrite an existing scene file that save_scene has written is replaced
/// @return the paths written
/// @throws Error for a file that is there already and may not be replaced, and when one cannot be written
std::vector<std::string> writeScene(const std::string& path, const std::vector<SavedFile>& files,
                                    bool overwrite);

/// The part of a path that the names of the files of its scene begin with: without folder and ending.
std::string stemOf(const std::string& path);

}  // namespace concave_distance::detail
