#include "scene_files.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "base/output_file.h"
#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

namespace fs = std::filesystem;

// Only a file that an earlier save has written may be replaced.
void requireReplaceable(const std::string& path, bool overwrite) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return;
  if (!overwrite) {
    throw Error(path, "the file is there already", "name another file, or set overwrite to replace it");
  }
  std::string first;
  if (fs::is_regular_file(path, ignored)) {
    std::ifstream stream(path, std::ios::binary);
    std::getline(stream, first);
  }
  if (first != kSavedSceneMark) {
    throw Error(path, "it is no scene that save_scene has written", "name another file");
  }
}

bool isBelow(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::string pathBelow(const std::string& folder, const std::string& path) {
  const fs::path given(path);
  if (given.extension() != ".yaml" || given.stem().empty())
    throw Error("path", "it is '" + path + "'", "name a file that ends in .yaml");
  if (folder.empty()) {
    throw Error("path", "no folder is known in which anything may be saved",
                "set ~save_folder, or write what get_scene answers");
  }
  std::error_code failure;
  const fs::path root = fs::canonical(folder, failure);
  if (failure)
    throw Error("~save_folder", "there is no folder '" + folder + "'", "create it, or name another");
  const fs::path parent = fs::canonical(root / given.parent_path(), failure);
  if (failure)
    throw Error("path", "there is no folder '" + (root / given.parent_path()).string() + "'", "create it");
  if (parent != root && !isBelow(parent, root)) {
    throw Error("path", "'" + path + "' is not below '" + root.string() + "'",
                "name a file below it, or set ~save_folder");
  }
  return (parent / given.filename()).string();
}

std::string stemOf(const std::string& path) {
  return fs::path(path).stem().string();
}

std::vector<std::string> writeScene(const std::string& path, const std::vector<SavedFile>& files,
                                    bool overwrite) {
  requireReplaceable(path, overwrite);
  const fs::path folder = fs::path(path).parent_path();
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<OutputFile>> outputs;
  for (const SavedFile& file : files) {
    paths.push_back(outputs.empty() ? path : (folder / file.name).string());
    outputs.push_back(std::make_unique<OutputFile>(paths.back()));
    outputs.back()->stream() << file.text;
    outputs.back()->complete();
  }
  std::vector<std::string> finished;
  try {
    for (std::size_t i = outputs.size(); i-- > 0;) {
      const bool is_new = !fs::exists(paths[i]);
      outputs[i]->finish();
      if (is_new) finished.push_back(paths[i]);
    }
  } catch (const Error&) {
    std::error_code ignored;
    for (const std::string& file : finished) fs::remove(file, ignored);
    throw;
  }
  return paths;
}

}  // namespace concave_distance::detail
