#pragma once

#include <string>

namespace concave_distance {

/// Returns the version of the package as package.xml says it, "1.0.0".
std::string packageVersion();

}  // namespace concave_distance
