#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/resource_locator.h"

namespace concave_distance::detail {

/// Where a mesh of a robot may lie.
struct MeshFolders {
  std::string base_folder;          ///< of relative paths; empty: none
  std::vector<std::string> search;  ///< tried when the resource leads nowhere; a file stands for its folder
};

struct FoundMesh {
  std::string path;
  std::string below;  ///< the folder of `search` that led there; empty: the resource itself did
};

/// locateResource, and when that fails for package:// and relative resources: the end of the resource's path
/// below the folders, the longest end first, so that package://arm/meshes/a.stl is found as arm/meshes/a.stl,
/// meshes/a.stl or a.stl. @throws Error as locateResource, with the folders that were tried
FoundMesh searchMesh(const std::string& resource, const MeshFolders& folders,
                     const PackageLocator& package_locator);

}  // namespace concave_distance::detail
