#pragma once

#include <string>
#include <utility>
#include <vector>

namespace concave_distance {

/// Returns the version of the package as package.xml says it, "1.0.0".
std::string packageVersion();

/// Lists the package, the compiler and the libraries that numbers come from, each with its version.
std::vector<std::pair<std::string, std::string>> buildVersions();

/// Returns them as the tools print them with --version, a line each.
std::string versionsText();

}  // namespace concave_distance
