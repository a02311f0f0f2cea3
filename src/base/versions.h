#pragma once

#include <string>
#include <utility>
#include <vector>

namespace concave_distance {

/// Lists the package, the compiler and the libraries that numbers come from, each with its version.
std::vector<std::pair<std::string, std::string>> buildVersions();

}  // namespace concave_distance
