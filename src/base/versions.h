#pragma once

#include <string>

namespace concave_distance {

/// Returns the version of the package as package.xml says it, "1.0.0".
std::string packageVersion();

/// Returns the package, the compiler and the libraries that numbers come from, each with its version on a
/// line.
std::string versionsText();

}  // namespace concave_distance
