#include "mesh_search.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

namespace fs = std::filesystem;

// "meshes/a.stl" -> "a.stl"; empty at the end.
std::string withoutFirstPart(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? std::string() : path.substr(slash + 1);
}

std::string folderOf(const std::string& place) {
  std::error_code ignored;
  return fs::is_directory(place, ignored) ? place : fs::path(place).parent_path().string();
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

std::optional<FoundMesh> searchBelow(const std::string& folder, const std::string& path) {
  for (std::string end = path; !end.empty(); end = withoutFirstPart(end)) {
    try {
      return FoundMesh{locateResource(end, folder, nullptr), folder};
    } catch (const Error&) {  // not there: a shorter end is tried
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
    std::string tried;
    for (const std::string& place : folders.search) {
      const std::string folder = folderOf(place);
      if (auto found = searchBelow(folder, *path)) return *found;
      tried += (tried.empty() ? "" : ", ") + folder;
    }
    throw Error(error.where(), error.whatIsWrong() + (tried.empty() ? "" : "; nor is it below " + tried),
                error.remedy() + ", or name the folder that holds the meshes in ~mesh_search_path");
  }
}

}  // namespace concave_distance::detail
