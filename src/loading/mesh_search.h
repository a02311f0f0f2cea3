#pragma once

#include <string>
#include <vector>

#include "concave_distance/loading/resource_locator.h"

namespace concave_distance::detail {

/// Folders that may hold a robot's meshes.
struct MeshFolders {
  std::string base_folder;  ///< of relative paths; empty: none
  /// Tried when it is not found. A file, such as the URDF, means its folder and the three above that.
  std::vector<std::string> search;
};

struct FoundMesh {
  std::string path;
  std::string below;  ///< the folder of `search` where it was found; empty: not needed
};

/// Calls locateResource. If that fails for a package:// or relative resource, looks for the end of its path
/// below the folders, the longest first: package://arm/meshes/a.stl is found as arm/meshes/a.stl,
/// meshes/a.stl or a.stl; in the folders above a file not by its name alone.
/// @throws Error as locateResource, with the folders that were tried
FoundMesh searchMesh(const std::string& resource, const MeshFolders& folders,
                     const PackageLocator& package_locator);

}  // namespace concave_distance::detail
