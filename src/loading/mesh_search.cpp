#include "mesh_search.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

namespace fs = std::filesystem;

// A URDF mostly stands in a folder of its package, which may stand among others in a repository.
constexpr int kFoldersAbove = 3;

/// A folder where ends of a path are looked for.
struct Place {
  std::string folder;
  bool is_above = false;  ///< only above a file that was named: there, a file name alone says too little
};

// "meshes/a.stl" -> "a.stl"; empty at the end.
std::string withoutFirstPart(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? std::string() : path.substr(slash + 1);
}

std::vector<Place> placesOf(const std::vector<std::string>& search) {
  std::vector<Place> places;
  for (const std::string& entry : search) {
    std::error_code ignored;
    if (fs::is_directory(entry, ignored)) {
      places.push_back({entry, false});
      continue;
    }
    fs::path folder = fs::path(entry).parent_path();
    places.push_back({folder.string(), false});
    folder = fs::absolute(folder, ignored).lexically_normal();
    for (int step = 0; step < kFoldersAbove && folder.has_relative_path(); ++step) {
      folder = folder.parent_path();
      if (folder.has_relative_path()) places.push_back({folder.string(), true});
    }
  }
  return places;
}

// The path of a resource that may be searched elsewhere; nothing for absolute ones.
std::optional<std::string> pathToSearch(const std::string& resource) {
  const std::string scheme = "package://";
  if (resource.compare(0, scheme.size(), scheme) == 0) return resource.substr(scheme.size());
  if (resource.empty() || resource.front() == '/' || resource.find("://") != std::string::npos) {
    return std::nullopt;
  }
  return resource;
}

// The longest end first, in every folder: it says most about which file is meant.
std::optional<FoundMesh> searchBelow(const std::vector<Place>& places, const std::string& path) {
  for (std::string end = path; !end.empty(); end = withoutFirstPart(end)) {
    const bool is_name_alone = end.find('/') == std::string::npos;
    for (const Place& place : places) {
      if (place.is_above && is_name_alone) continue;
      try {
        return FoundMesh{locateResource(end, place.folder, nullptr), place.folder};
      } catch (const Error&) {  // not there: the next folder or a shorter end is tried
      }
    }
  }
  return std::nullopt;
}

}  // namespace

FoundMesh searchMesh(const std::string& resource, const MeshFolders& folders,
                     const PackageLocator& package_locator) {
  try {
    return {locateResource(resource, folders.base_folder, package_locator), ""};
  } catch (const Error& error) {
    const std::optional<std::string> path = pathToSearch(resource);
    if (!path) throw;
    const std::vector<Place> places = placesOf(folders.search);
    if (auto found = searchBelow(places, *path)) return *found;
    std::string tried;
    for (const Place& place : places) tried += (tried.empty() ? "" : ", ") + place.folder;
    throw Error(error.where(), error.whatIsWrong() + (tried.empty() ? "" : "; nor is it below " + tried),
                error.remedy() + ", or name the folder that holds the meshes in ~mesh_search_path");
  }
}

}  // namespace concave_distance::detail
