#include "scene_files.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "base/output_file.h"
#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoFolder = "no folder is known in which anything may be saved";

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
  if (folder.empty()) throw Error("path", kNoFolder, "set ~save_folder, or write what get_scene answers");
  return placeBelow(folder, path, "path");
}

std::string placeBelow(const std::string& folder, const std::string& path, const std::string& field) {
  if (folder.empty()) throw Error(field, kNoFolder, "set ~save_folder, and start the node again");
  const fs::path given(path);
  if (given.filename().empty() || given.filename() == "." || given.filename() == "..")
    throw Error(field, "it is '" + path + "'", "end it with a name");
  std::error_code failure;
  const fs::path root = fs::canonical(folder, failure);
  if (failure)
    throw Error("~save_folder", "there is no folder '" + folder + "'", "create it, or name another");
  const fs::path parent = fs::canonical(root / given.parent_path(), failure);
  if (failure)
    throw Error(field, "there is no folder '" + (root / given.parent_path()).string() + "'", "create it");
  if (parent != root && !isBelow(parent, root)) {
    throw Error(field, "'" + path + "' is not below '" + root.string() + "'",
                "name a place below it, or set ~save_folder");
  }
  return (parent / given.filename()).string();
}

void requireAbsent(const std::string& folder) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(folder, ignored)))
    throw Error(folder, "it is there already", "name another folder, or none: then a name is made");
}

std::vector<std::string> writeFolder(const std::string& folder, const std::vector<SavedFile>& files) {
  requireAbsent(folder);
  const fs::path target(folder);
  const fs::path partial =
      target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()));
  std::error_code failure;
  if (!fs::create_directory(partial, failure)) {
    throw Error(folder,
                "the folder cannot be written: " + (failure ? failure.message() : "it is being written"),
                "check the folder above it and its permissions");
  }
  std::vector<std::string> paths;
  try {
    for (const SavedFile& file : files) {
      OutputFile output((partial / file.name).string());
      output.stream() << file.text;
      output.finish();
      paths.push_back((target / file.name).string());
    }
    requireAbsent(folder);
    fs::rename(partial, target);
  } catch (const std::exception& problem) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);
    throw Error(folder, std::string("nothing was written: ") + problem.what(),
                "check the disk, or name another folder");
  }
  return paths;
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
