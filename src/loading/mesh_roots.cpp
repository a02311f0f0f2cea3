#include "concave_distance/loading/mesh_roots.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "concave_distance/base/error.h"
#include "mesh/import/mesh_file.h"
#include "resource_paths.h"

namespace concave_distance {
namespace {

namespace fs = std::filesystem;

bool isBelowAny(const std::string& path, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return isBelow(path, folder); });
}

// Without a slash at the end, which isBelow() does not expect.
std::string normalFolder(const std::string& folder) {
  std::string normal = fs::path(folder).lexically_normal().string();
  while (normal.size() > 1 && normal.back() == '/') normal.pop_back();
  return normal;
}

std::vector<std::string> realFolders(const std::vector<std::string>& folders) {
  std::vector<std::string> real;
  for (const std::string& folder : folders) {
    std::error_code missing;
    const fs::path path = fs::canonical(folder, missing);
    if (!missing) real.push_back(path.string());
  }
  return real;
}

// Compares names only, so that files elsewhere are not looked up.
bool isNamedBelow(const std::string& path, const std::vector<std::string>& folders,
                  const std::vector<std::string>& real_folders) {
  const std::string normal = fs::path(path).lexically_normal().string();
  return isBelowAny(normal, folders) || isBelowAny(normal, real_folders);
}

// weakly_canonical() does not resolve a link to a file that does not exist.
bool hasDanglingLink(const fs::path& path) {
  fs::path part;
  for (const fs::path& name : path) {
    part /= name;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(part, ignored)) && !fs::exists(part, ignored)) return true;
  }
  return false;
}

// Resolves links; a missing file counts by where it would be.
bool isReallyBelow(const std::string& path, const std::vector<std::string>& real_folders) {
  if (hasDanglingLink(path)) return false;
  std::error_code failure;
  const fs::path real = fs::weakly_canonical(path, failure);
  return !failure && isBelowAny(real.string(), real_folders);
}

bool allows(const MeshRoots& roots, const std::string& package) {
  return roots.every_package ||
         std::find(roots.packages.begin(), roots.packages.end(), package) != roots.packages.end();
}

}  // namespace

MeshRoots parseMeshRoots(const std::vector<std::string>& entries, const std::string& where) {
  MeshRoots roots;
  for (const std::string& entry : entries) {
    const std::optional<std::string> package = detail::packageOf(entry);
    if (package && package->empty()) {
      roots.every_package = true;
    } else if (package) {
      roots.packages.push_back(*package);
    } else if (fs::path(entry).is_absolute()) {
      roots.folders.push_back(normalFolder(entry));
    } else {
      throw Error(where, "an entry is '" + entry + "'",
                  "allowed: package:// (every package), package://<package>, or an absolute folder");
    }
  }
  return roots;
}

LocatedMesh locateMeshBelow(const std::string& resource, const MeshRoots& roots,
                            const PackageLocator& package_locator) {
  const std::optional<std::string> package = detail::packageOf(resource);
  if (package && !allows(roots, *package)) throw outsideOfMeshFolders(resource);
  const detail::ResourcePaths paths = detail::resourcePaths(resource, "", package_locator);
  std::vector<std::string> folders = roots.folders;
  if (package) folders.push_back(normalFolder(paths.package_folder));
  LocatedMesh located;
  located.real_folders = realFolders(folders);
  const bool allowed =
      std::all_of(paths.candidates.begin(), paths.candidates.end(), [&](const std::string& candidate) {
        return isNamedBelow(candidate, folders, located.real_folders) &&
               isReallyBelow(candidate, located.real_folders);
      });
  if (!allowed) throw outsideOfMeshFolders(resource);
  located.path = detail::firstFile(resource, paths.candidates);
  return located;
}

}  // namespace concave_distance
