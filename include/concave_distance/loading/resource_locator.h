#pragma once

#include <functional>
#include <string>
#include <vector>

namespace concave_distance {

/// Gives a package's folder, empty when it is not known. The node passes rospack's, tools search
/// ROS_PACKAGE_PATH (packagePathFromEnvironment): so the core links no ROS library.
using PackageLocator = std::function<std::string(const std::string& package)>;

/// Looks for `<package>/package.xml` under each folder of ROS_PACKAGE_PATH, CMAKE_PREFIX_PATH's share and
/// /usr/share, then crawls the folders of ROS_PACKAGE_PATH for a package.xml of that name. Empty when none.
std::string packagePathFromEnvironment(const std::string& package);

/// Looks for packages below these folders, as for those of ROS_PACKAGE_PATH, then as above.
PackageLocator packagesBelow(std::vector<std::string> folders);

/// Turns package://, file:// and paths relative to `base_folder` into a path of this machine.
/// Percent codes are decoded, and taken literally where only that names a file. An empty
/// `base_folder` has no relative paths.
/// @throws Error naming the resource: unknown package or scheme, empty, missing file
std::string locateResource(const std::string& resource, const std::string& base_folder,
                           const PackageLocator& package_locator);

}  // namespace concave_distance
