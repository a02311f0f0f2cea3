#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/ascii.h"

namespace concave_distance::detail {

/// The file name's ending with its dot, in lower case.
inline std::string lowerCaseExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), lowerCase);
  return extension;
}

}  // namespace concave_distance::detail
