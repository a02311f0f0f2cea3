#pragma once

#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/resource_locator.h"

namespace concave_distance::detail {

/// The paths that a resource may mean, before anything is looked up in the file system.
struct ResourcePaths {
  std::vector<std::string> candidates;  ///< absolute, or relative to the working folder; at least one
  std::string package_folder;           ///< empty: no package://
};

/// The package of a package:// resource; nothing for any other resource.
std::optional<std::string> packageOf(const std::string& resource);

/// @throws Error as locateResource, except for missing files
ResourcePaths resourcePaths(const std::string& resource, const std::string& base_folder,
                            const PackageLocator& package_locator);

/// The first candidate that is a regular file. @throws Error naming the resource when none is
std::string firstFile(const std::string& resource, const std::vector<std::string>& candidates);

}  // namespace concave_distance::detail
